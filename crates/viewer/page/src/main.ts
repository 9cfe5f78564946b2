// The page of embate's viewer: asks what there is to show, and puts its parts together, or explains what is
// wrong.

import "uplot/dist/uPlot.min.css";
import "./app/theme.css";
import "./app/style.css";
import "./app/panel.css";
import type { FaultyRun, Runs } from "./types";
import { App } from "./app/app";
import { help } from "./app/dialogs";
import { fill, h } from "./app/dom";
import { exportDialog, savePicture } from "./app/export";
import { faultyRuns, unreachable } from "./app/fault";
import { listenToKeys } from "./app/keys";
import { Model, reloadAfter } from "./app/model";
import type { About } from "./app/model_types";
import { faultyModel } from "./app/panel_model";
import { banners, liveBar } from "./app/livebar";
import { SidePanel } from "./app/panel";
import { copyText } from "./app/panel_rest";
import { Picks } from "./app/picks";
import { Probes } from "./app/probes";
import { Requests } from "./app/requests";
import { Stage } from "./app/stage";
import { apply, isDark, onSystem } from "./app/theme";
import { Timeline } from "./app/timeline";
import { Tracks } from "./app/tracks";
import { pictureTools, toolbar } from "./app/toolbar";

const root = document.getElementById("app")!;

async function start(): Promise<void> {
  apply("auto");
  const requests = new Requests();
  let served: Runs;
  try {
    served = await requests.json<Runs>("api/runs", 0);
  } catch (fault) {
    fill(root, unreachable(fault));
    return;
  }
  if (served.model) return shownModel(served, requests);
  const faulty = served.runs.filter((run): run is FaultyRun => "fault" in run);
  if (faulty.length === served.runs.length) {
    document.title = "embate: can't be shown";
    fill(root, faultyRuns(faulty));
    return;
  }
  page(new App(served, requests));
}

/** The page of a model before it runs, or what is wrong with one of which nothing can be drawn. */
async function shownModel(served: Runs, requests: Requests): Promise<void> {
  const about = await requests.json<About>("api/model", 0);
  if (!about.has_bodies) {
    document.title = "faults · embate";
    fill(root, faultyModel(about));
    return reloadAfter(requests, about);
  }
  const app = new App(served, requests);
  app.model = new Model(app, about);
  page(app);
}

function page(app: App): void {
  apply(app.view.theme);
  const names = () => {
    const percent = app.live?.progress && !app.live.ended ? `${Math.floor((100 * app.live.progress.time) / (app.live.progress.end ?? app.end))} % · ` : "";
    const title = `${percent}${app.sessions.map((session) => session.run.name).join(" · ")} · embate`;
    if (document.title !== title) document.title = title;
  };
  names();
  app.events.on(["run", "live"], names);
  app.events.on("theme", () => apply(app.view.theme));
  // applied before the others hear of it, as they read its colours
  const theme = () => {
    const next = isDark(app.view.theme) ? "light" : "dark";
    apply(next);
    app.change({ theme: next });
  };
  onSystem(() => {
    if (app.view.theme !== "auto") return;
    apply("auto");
    app.events.emit("theme");
  });

  const picks = new Picks(app, new Probes(app, new Tracks(app)));
  const stage = new Stage(app, picks);
  const panel = new SidePanel(app, picks, stage);
  const actions = { help, theme, export: () => exportDialog(app, stage, panel), screenshot: () => void savePicture(app, stage), link: () => void copyText(app, app.link(), "Link to this view copied.") };
  fill(root, h("div", { class: "page" },
    toolbar(app, actions), banners(app), liveBar(app),
    h("main", { class: "middle" }, h("div", { class: "stage" }, stage.element, pictureTools(app, stage)), app.model === null && new Timeline(app).element), panel.element));
  listenToKeys(app, stage, picks, actions);
  app.start();
}

void start().catch((fault: unknown) => fill(root, unreachable(fault)));
