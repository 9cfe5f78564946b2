"""Simulations that are changed between steps, and used as they should not be: from two threads, after a fork, after their end, with Ctrl-C."""

from __future__ import annotations

import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import STEEL, sections

import embate


def free_block(**changes: Any) -> embate.Model:
    """A block of 0.04 m x 0.02 m that nothing touches: 6.24 kg/m."""
    part = {"name": "block", "material": "steel", "rectangle": {"corner": [0, 0], "size": [0.04, 0.02], "elements": [8, 4]}}
    return embate.Model({"run": {"end": "200 us"}, "material": {"steel": STEEL}, "part": [{**part, **changes}], "output": {"history": "10 us"}})


MASS = 0.04 * 0.02 * 7800


def test_what_is_thrown_has_its_velocity_at_once_and_the_books_close() -> None:
    simulation = free_block().simulation()
    simulation.step(10).set_velocity("block", (30.0, -40.0))
    np.testing.assert_array_equal(simulation.state.velocity, np.tile([30.0, -40.0], (45, 1)))
    work = 0.5 * MASS * 50.0**2
    for _ in range(2):
        energy = simulation.energy
        assert energy["kinetic"] == pytest.approx(work) and energy["external"] == pytest.approx(work)
        assert energy["drift"] < 1e-9
        simulation.run()
    assert simulation.summary["ledger_residual"] < 1e-12
    way = simulation.state.displacement
    np.testing.assert_allclose(way[:, 1] / way[:, 0], -4 / 3, rtol=1e-9)


def test_a_thrown_body_flies_as_one_that_the_model_throws() -> None:
    thrown, begun = free_block().simulation(), free_block(velocity=(25.0, 5.0)).simulation()
    thrown.set_velocity("block", (25.0, 5.0))
    thrown.run(), begun.run()
    np.testing.assert_allclose(thrown.state.position, begun.state.position, atol=1e-15)


def test_a_force_acts_until_it_ends() -> None:
    simulation = free_block().simulation()
    simulation.step(5)
    where = simulation.nodes("block.left")
    assert len(where) == 5 and np.abs(simulation.state.position[where, 0]).max() < 1e-12
    simulation.set_force("block.left", (1e5, 0.0))
    begin = simulation.time
    simulation.run(100e-6)
    lasted = simulation.time - begin
    simulation.set_force(where, None)
    simulation.step(2)
    shares = node_masses(simulation)
    speed = (simulation.state.velocity[:, 0] * shares).sum() / shares.sum()
    assert speed == pytest.approx(1e5 * lasted / MASS, rel=0.02)
    work = simulation.energy["external"]
    assert work > 0
    simulation.run()
    assert simulation.energy["external"] == pytest.approx(work, rel=1e-12)
    assert simulation.energy["drift"] < 1e-2 and simulation.summary["ledger_residual"] < 1e-12


def node_masses(simulation: embate.Simulation) -> np.ndarray[Any, Any]:
    """Those of a free block, by its initial positions."""
    x = simulation.state.position - simulation.state.displacement
    on_edge = [(np.abs(x[:, k]) < 1e-9) | (np.abs(x[:, k] - size) < 1e-9) for k, size in enumerate((0.04, 0.02))]
    return np.where(on_edge[0], 0.5, 1.0) * np.where(on_edge[1], 0.5, 1.0)


def test_solids_are_thrown_and_pushed_in_space() -> None:
    cuboid = {"corner": [0, 0, 0], "size": [0.02, 0.01, 0.01], "elements": [4, 2, 2]}
    part = {"name": "bar", "material": "steel", "box": cuboid}
    simulation = embate.Model({"run": {"end": "100 us"}, "material": {"steel": STEEL}, "part": [part]}).simulation()
    simulation.step(10).set_velocity("bar", (3.0, -2.0, 6.0))
    mass = 0.02 * 0.01 * 0.01 * 7800
    assert simulation.energy["kinetic"] == pytest.approx(0.5 * mass * 49)
    simulation.run(50e-6)
    assert simulation.energy["external"] == pytest.approx(0.5 * mass * 49) and simulation.energy["drift"] < 1e-9
    np.testing.assert_allclose(simulation.state.velocity, np.tile([3.0, -2.0, 6.0], (45, 1)), rtol=1e-9)
    simulation.set_force("bar.right", (0.0, 0.0, 1000.0))
    simulation.run()
    assert simulation.state.velocity[:, 2].mean() > 6.0 and simulation.summary["ledger_residual"] < 1e-12


def test_a_callback_steers_and_its_run_is_the_same_each_time_and_goes_on_from_a_file(tmp_path: Path, model: embate.Model) -> None:
    def brake(simulation: embate.Simulation) -> None:
        simulation.set_velocity("upper", 0.9 * simulation.state.velocity[simulation.nodes("upper")])
        simulation.set_force("upper.top", (0.0, -1e4 * simulation.steps))

    hashes = set()
    for threads in (1, 2, 2):
        simulation = model.simulation(threads=threads)
        simulation.every(25, brake)
        simulation.run()
        assert simulation.energy["external"] != 0 and simulation.summary["ledger_residual"] < 1e-10
        hashes.add(simulation.hash())
    # Forces are part of what is saved.
    half = model.simulation()
    half.every(25, brake)
    half.run(15e-6)
    again = embate.load(half.save(tmp_path / "half"))
    again.every(25, brake)
    hashes.add(again.run().hash())
    assert len(hashes) == 1
    assert hashes != {model.simulation().run().hash()}


def test_nodes_are_named_or_numbered_or_masked(model: embate.Model) -> None:
    simulation = model.simulation()
    assert len(simulation.nodes("lower")) == 44 and len(simulation.nodes("upper.bottom")) == 6
    mask = simulation.state.position[:, 1] > 0.0141
    np.testing.assert_array_equal(simulation.nodes(mask), np.flatnonzero(mask))
    np.testing.assert_array_equal(np.sort(simulation.nodes("upper.top")), np.flatnonzero(mask))
    velocities = np.arange(12.0).reshape(6, 2)
    velocities.setflags(write=False)
    simulation.set_velocity(mask, velocities)
    np.testing.assert_allclose(simulation.state.velocity[mask], velocities, atol=1e-12)
    # Neither order nor kind of numbers matters.
    simulation.set_velocity(np.flatnonzero(mask)[::-1].astype(np.int16), np.asfortranarray(velocities[::-1].astype(np.float32)))
    np.testing.assert_allclose(simulation.state.velocity[mask], velocities, atol=1e-12)
    simulation.set_velocity([], np.empty((0, 2)))
    simulation.set_force(3, (1, 2))


@pytest.mark.parametrize(
    ("where", "value", "error", "told"),
    [
        ("uper", (0, 0), ValueError, "where: .*'uper'.*lower, upper"),
        ([0, 80], (0, 0), ValueError, "where: there is no node 80"),
        ([-1], (0, 0), ValueError, "where: there is no node -1"),
        ([0.5], (0, 0), TypeError, "where: an array of float64"),
        ([[0, 1]], (0, 0), ValueError, r"where: .*\(1, 2\)"),
        ([1, 1], (0, 0), ValueError, "where: a node is named twice"),
        (np.ones(7, bool), (0, 0), ValueError, r"where: a mask of shape \(7,\)"),
        (None, (0, 0), TypeError, "where: an array of object"),
        ("upper", (0, 0, 0), ValueError, r"VALUE: .*\(3,\)"),
        ("upper", np.zeros((35, 2)), ValueError, r"VALUE: .*\(35, 2\)"),
        ("upper", ("1 m/s", 0), TypeError, "VALUE: an array of <U"),
        ("upper", (1j, 0), TypeError, "VALUE: an array of complex128"),
        ("upper", (np.nan, 0), ValueError, "VALUE: .*nan.* not finite"),
        ([4, 5], [[0, 0], [np.inf, 0]], ValueError, "VALUE: .*the vector 1.*not finite"),
    ],
)
def test_wrong_arguments_are_named_and_change_nothing(model: embate.Model, where: Any, value: Any, error: type, told: str) -> None:
    simulation = model.simulation()
    before = simulation.hash()
    for name, change in (("velocity", simulation.set_velocity), ("force", simulation.set_force)):
        with pytest.raises(error, match=told.replace("VALUE", name)):
            change(where, value)
    assert simulation.hash() == before


def test_nodes_that_something_else_leads_are_refused_with_a_code() -> None:
    simulation = free_block(rigid=True).simulation()
    with pytest.raises(embate.StateError, match="rigid part") as caught:
        simulation.set_velocity("block", (1.0, 0.0))
    assert caught.value.code == "E0609" and caught.value.cure
    simulation.set_force("block", (1e5, 0.0))
    simulation.run()
    assert simulation.state.velocity[0, 0] == pytest.approx(1e5 * 200e-6 / MASS, rel=0.02)


def test_a_simulation_that_is_closed_says_so(model: embate.Model) -> None:
    with model.simulation() as simulation:
        simulation.step()
    uses = [
        simulation.run,
        simulation.step,
        simulation.hash,
        lambda: simulation.state.position,
        lambda: simulation.history,
        lambda: simulation.energy,
        lambda: simulation.time,
        lambda: simulation.nodes("upper"),
        lambda: simulation.set_velocity("upper", (0, 0)),
        lambda: simulation.set_force([0], (0, 0)),
        lambda: simulation.save("nowhere"),
    ]
    for use in uses:
        with pytest.raises(embate.StateError, match="closed"):
            use()
    simulation.close()
    assert "closed" in repr(simulation)


def test_a_run_that_failed_is_not_changed() -> None:
    simulation = embate.Model(sections(run={"end": "40 us", "energy_limit": 1e-9})).simulation()
    with pytest.raises(embate.RunError):
        simulation.run()
    with pytest.raises(embate.StateError, match="failed"):
        simulation.set_velocity("upper", (0, 0))


def test_a_callback_can_not_step(model: embate.Model) -> None:
    simulation = model.simulation()
    simulation.every(4, lambda it: it.step())
    with pytest.raises(embate.StateError, match="being stepped already"):
        simulation.run()
    assert simulation.steps == 4


def test_a_second_thread_is_told_that_a_simulation_is_at_work() -> None:
    simulation = free_block(velocity=(1, 0)).with_set({"run.end": "50 ms"}).simulation(threads=1)
    failed: list[BaseException] = []

    def run() -> None:
        try:
            simulation.run(20e-3)
        except BaseException as error:
            failed.append(error)

    thread = threading.Thread(target=run)
    thread.start()
    told = 0
    while thread.is_alive():
        try:
            simulation.run()
        except embate.StateError:
            told += 1
        time.sleep(1e-3)
        if told > 3:
            break
    thread.join()
    # The first one never sees the others.
    assert not failed and told > 0
    assert simulation.time >= 20e-3


def test_two_simulations_run_in_two_threads(model: embate.Model) -> None:
    alone = model.simulation(threads=1).run().hash()
    simulations = [model.simulation(threads=1) for _ in range(4)]
    threads = [threading.Thread(target=simulation.run) for simulation in simulations]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert {simulation.hash() for simulation in simulations} == {alone}


def in_child(simulation: embate.Simulation, pipe: Any) -> None:
    told = []
    for use in (simulation.step, simulation.hash, lambda: simulation.state.position, simulation.run, lambda: simulation.set_force([0], (0, 0))):
        try:
            use()
            told.append("nothing")
        except embate.StateError as error:
            told.append(str(error))
    simulation.close()
    # One of its own is no matter.
    told.append(embate.Model(sections(), name="blocks").simulation(threads=1).run().hash())
    pipe.send(told)
    pipe.close()


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no forks here")
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
@pytest.mark.parametrize("threads", [1, 2])
def test_a_child_of_a_fork_can_not_use_what_its_parent_made(model: embate.Model, threads: int) -> None:
    simulation = model.simulation(threads=threads)
    simulation.step(5)
    context = multiprocessing.get_context("fork")
    mine, its = context.Pipe(False)
    child = context.Process(target=in_child, args=(simulation, its))
    child.start()
    assert mine.poll(60), "the child hangs"
    told = mine.recv()
    child.join(60)
    assert child.exitcode == 0
    assert len(told) == 6 and all("process" in text for text in told[:5]), told
    assert simulation.run().hash() == told[5]


def test_errors_go_through_pickle() -> None:
    with pytest.raises(embate.ModelError) as caught:
        embate.Model(sections(part=[])).check()
    error = caught.value
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is embate.ModelError and isinstance(again, ValueError)
    assert (str(again), again.faults, again.code) == (str(error), error.faults, error.code)
    assert again.code.startswith("E01") and again.place and again.cure
    for kind in (embate.RunError, embate.StateError, embate.FileError, embate.InternalError):
        again = pickle.loads(pickle.dumps(kind("wrong", [{"code": "E0601", "path": "", "message": "m", "help": "h"}])))
        assert type(again) is kind and str(again) == "wrong" and again.code == "E0601"


INTERRUPTED = """
import signal, sys, embate
sys.path.insert(0, {tests!r})
from conftest import sections
# A shell's job in the background is born without it.
signal.signal(signal.SIGINT, signal.default_int_handler)
# The bodies fly apart for ever.
model = embate.Model(sections(run={{"end": "10 s"}}, output={{"history": "1 us", "fields": "1 s", "pictures": False}}))
simulation = model.simulation()
simulation.every(500, lambda it: print("begun", flush=True) if it.steps == 500 else None)
try:
    simulation.run({out})
    print("not interrupted", flush=True)
except KeyboardInterrupt:
    print(simulation.steps >= 500 and not simulation.is_over, len(simulation.history["time"]) > 1, flush=True)
simulation.step(100)
print(simulation.hash() == model.simulation().step(simulation.steps).hash(), flush=True)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="signals of Unix")
@pytest.mark.parametrize("out", [False, True])
def test_ctrl_c_stops_between_two_steps_and_the_run_goes_on(tmp_path: Path, out: bool) -> None:
    text = INTERRUPTED.format(tests=str(Path(__file__).parent), out=f"out={str(tmp_path / 'out')!r}" if out else "")
    with subprocess.Popen([sys.executable, "-c", text], stdout=subprocess.PIPE, text=True) as child:
        assert child.stdout is not None
        assert child.stdout.readline() == "begun\n"
        begin = time.monotonic()
        child.send_signal(signal.SIGINT)
        assert child.stdout.readline() == "True True\n"
        assert time.monotonic() - begin < 5
        assert child.stdout.readline() == "True\n"
        assert child.wait(60) == 0
    if out:
        assert '"status": "stopped"' in (tmp_path / "out" / "summary.json").read_text()


def pulled() -> embate.Model:
    """A free block under a field of 1000 m/s² times a curve, which is zero until it is driven."""
    model = free_block()
    model.curve("pull", time=[0], value=[0])
    return model.load(gravity=(1000, 0), curve="pull")


def test_a_driven_curve_moves_what_follows_it_and_the_books_close() -> None:
    simulation = pulled().simulation()
    simulation.step(10)
    assert simulation.curve("pull") == 0
    simulation.set_curve("pull", np.float32(1))
    assert simulation.curve("pull") == 1
    # The velocities of the coming step stand already.
    begin = simulation.time + simulation.dt
    simulation.step(30)
    speed = 1000.0 * (simulation.time - begin)
    np.testing.assert_allclose(simulation.state.velocity[:, 0], speed, rtol=1e-9)
    # The kinetic energy is that of both half steps, ½ m v⁻ v⁺.
    assert simulation.energy["external"] == pytest.approx(simulation.energy["kinetic"], rel=1e-9)
    assert simulation.energy["kinetic"] == pytest.approx(0.5 * MASS * (speed**2 - (500.0 * simulation.dt) ** 2), rel=1e-6)
    assert simulation.summary["ledger_residual"] < 1e-12
    assert any(text.startswith("W0606") for text in simulation.summary["warnings"])
    # In a straight line back to zero.
    end = simulation.time + 50e-6
    simulation.set_curve("pull", 0, until=end)
    step = simulation.dt
    begin = simulation.time + step
    simulation.run(end + 10e-6)
    assert simulation.curve("pull") == 0
    np.testing.assert_allclose(simulation.state.velocity[:, 0], speed + 1000.0 * (step + 0.5 * (end - begin)), rtol=1e-9)


def test_what_is_driven_at_every_step_has_the_same_bits_in_pieces_and_with_more_threads(tmp_path: Path) -> None:
    def drive(it: embate.Simulation) -> None:
        at = it.time + 2 * it.dt
        it.set_curve("pull", np.sin(1e5 * at), until=at)

    hashes = set()
    for threads in (1, 2):
        simulation = pulled().simulation(threads=threads)
        simulation.every(1, drive)
        hashes.add(simulation.run().hash())
    pieces = pulled().simulation()
    pieces.every(1, drive)
    pieces.step(17)
    # A state keeps what the curve was driven to.
    again = embate.load(pieces.run(90e-6).save(tmp_path / "half"))
    again.every(1, drive)
    hashes.add(again.run().hash())
    assert len(hashes) == 1
    assert any(text.startswith("W0606") for text in again.summary["warnings"])


@pytest.mark.parametrize(
    ("arguments", "error", "told"),
    [
        (("puul", 1.0), embate.StateError, "did you mean `pull`"),
        (("pull", "much"), TypeError, "value is 'much'"),
        (("pull", float("nan")), embate.StateError, "finite"),
        (("pull", 1.0, "soon"), TypeError, "until"),
        (("pull", 1.0, 0.0), embate.StateError, "still to come"),
    ],
)
def test_curves_that_can_not_be_driven_are_told(arguments: tuple[Any, ...], error: type, told: str) -> None:
    simulation = pulled().simulation()
    simulation.step(3)
    with pytest.raises(error, match=told):
        simulation.set_curve(*arguments)
    assert simulation.curve("pull") == 0
    with pytest.raises(ValueError, match="no curve"):
        simulation.curve("puul")
