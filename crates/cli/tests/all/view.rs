//! `embate view` and `run --watch` from outside: who is let in, what is answered, when it ends, and that a
//! run that is watched is the run that it is otherwise.

use crate::{FLIGHT, embate, fresh};
use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

/// A program that shows a page; ended when it is dropped.
struct Page {
    child: Child,
    port: u16,
    token: String,
}

impl Drop for Page {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Page {
    fn open(folder: &Path, arguments: &[&str]) -> Self {
        let mut command = Command::new(env!("CARGO_BIN_EXE_embate"));
        let mut child =
            command.args(arguments).arg("--no-open").current_dir(folder).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
        let mut lines = BufReader::new(child.stderr.take().unwrap()).lines();
        let line = lines.find_map(|line| line.unwrap().strip_prefix("page: http://127.0.0.1:").map(ToString::to_string)).unwrap();
        let (port, token) = line.split_once('/').unwrap();
        // What is reported later has somewhere to go.
        std::thread::spawn(move || lines.for_each(drop));
        Self { child, port: port.parse().unwrap(), token: token.trim_end_matches('/').into() }
    }

    /// Status and body of an answer.
    fn get(&self, path: &str, headers: &str) -> (u16, Vec<u8>) {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(20))).unwrap();
        let host = if headers.contains("Host:") { String::new() } else { format!("Host: 127.0.0.1:{}\r\n", self.port) };
        write!(stream, "GET {path} HTTP/1.1\r\n{host}Connection: close\r\n{headers}\r\n").unwrap();
        let mut bytes = Vec::new();
        stream.read_to_end(&mut bytes).unwrap();
        let end = bytes.windows(4).position(|window| window == b"\r\n\r\n").unwrap();
        let status = String::from_utf8_lossy(&bytes[9..12]).parse().unwrap();
        (status, bytes[end + 4..].to_vec())
    }

    /// What is there below the token.
    fn own(&self, path: &str) -> (u16, Vec<u8>) {
        self.get(&format!("/{}/{path}", self.token), "")
    }
}

/// Results of a short run.
fn results(name: &str) -> std::path::PathBuf {
    let folder = fresh(name);
    fs::write(folder.join("model.toml"), FLIGHT).unwrap();
    let answer = embate(&folder, ["run", "model.toml", "--out", "out", "--quiet"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    folder
}

#[test]
fn who_knows_the_token_is_let_in_and_nobody_else() {
    let folder = results("view-token");
    let page = Page::open(&folder, &["view", "out"]);
    assert_eq!(page.token.len(), 32);
    assert!(page.own("").1.starts_with(b"<!doctype html") || page.own("").1.starts_with(b"<!DOCTYPE html"));
    assert_eq!(page.own("app.js").0, 200);
    let (status, runs) = page.own("api/runs");
    let runs: serde_json::Value = serde_json::from_slice(&runs).unwrap();
    assert_eq!((status, &runs["runs"][0]["elements"], &runs["live"]), (200, &4.into(), &false.into()));
    assert_eq!(runs["runs"][0]["frames"].as_array().unwrap().len(), 5);
    for wrong in ["/", "/api/runs", "/0123456789abcdef0123456789abcdef/api/runs", "//api/runs", "/%2e%2e/api/runs"] {
        assert_eq!(page.get(wrong, "").0, 403, "{wrong}");
    }
    let own = format!("/{}/api/runs", page.token);
    let answered = |headers: &str| page.get(&own, headers).0;
    assert_eq!(answered(&format!("Origin: http://127.0.0.1:{}\r\n", page.port)), 200);
    assert_eq!(answered("Origin: http://evil.example\r\n"), 403);
    assert_eq!(answered("Origin: null\r\n"), 403);
    assert_eq!(answered(&format!("Host: evil.example:{}\r\n", page.port)), 403);
}

#[test]
fn what_is_not_there_is_reported_so() {
    let folder = results("view-missing");
    let page = Page::open(&folder, &["view", "out"]);
    for (path, status) in [
        ("api/runs/0/frames/4?scalar=velocity&arrows=1", 200),
        ("api/runs/0/frames/99", 404),
        ("api/runs/7", 404),
        ("api/runs/0/topology/5", 404),
        ("api/runs/0/probe?scalar=velocity&node=8", 200),
        ("api/runs/0/probe?scalar=velocity&node=9", 404),
        ("api/runs/0/probe?scalar=smell&node=1", 404),
        ("api/runs/0/frames/minus-one", 400),
        ("secret.txt", 404),
        ("api/live", 403),
    ] {
        assert_eq!(page.own(path).0, status, "{path}");
    }
    fs::write(folder.join("out/fields/frame-00002.vtu"), "rubbish").unwrap();
    let (status, reported) = page.own("api/runs/0/frames/2");
    let reported: serde_json::Value = serde_json::from_slice(&reported).unwrap();
    assert_eq!((status, &reported["code"]), (422, &"E0731".into()));
    assert!(reported["error"].as_str().unwrap().contains("frame-00002.vtu"));
}

/// The answer to any request.
fn asked(page: &Page, request: &str) -> (u16, String, serde_json::Value) {
    let mut stream = TcpStream::connect(("127.0.0.1", page.port)).unwrap();
    stream.set_read_timeout(Some(Duration::from_secs(20))).unwrap();
    write!(stream, "{request}").unwrap();
    let mut text = String::new();
    stream.read_to_string(&mut text).unwrap();
    let (head, body) = text.split_once("\r\n\r\n").unwrap();
    (
        head[9..12].parse().unwrap(),
        head.to_lowercase(),
        serde_json::from_str(body).unwrap_or_else(|error| panic!("{request:?}: {error}: {text}")),
    )
}

#[test]
fn every_error_is_json_and_says_what_is_wrong() {
    let folder = results("view-json");
    let page = Page::open(&folder, &["view", "out"]);
    let own = format!("/{}", page.token);
    let socket = "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n";
    for (method, path, more, status, what) in [
        ("GET", "/api/runs/zero", "", 400, "`zero`"),
        ("GET", "/api/runs/-1", "", 400, "`-1`"),
        ("GET", "/api/runs/99999999999999999999999", "", 400, "cannot parse"),
        ("GET", "/api/runs/0/history?rows=many", "", 400, "rows"),
        ("GET", "/api/runs/0/probe?node=0&node=1", "", 400, "node"),
        ("GET", "/api/runs/%ff", "", 400, "utf-8"),
        ("GET", "/api/nothing", "", 404, "api/runs"),
        ("GET", "/api/runs/0/nothing", "", 404, "api/runs"),
        ("GET", "/api/", "", 404, "api/runs"),
        ("POST", "/api/runs", "Content-Type: application/json\r\nContent-Length: 1\r\n", 405, "get"),
        ("PUT", "/api/runs/0/frames/0", "", 405, "get"),
        ("DELETE", "/", "", 405, "get"),
        ("GET", "/api/live", "", 403, "does not say"),
        ("GET", "/api/live", "Origin: ", 400, "connection"),
        ("GET", "/api/live", &format!("{socket}Origin: "), 400, "connection"),
    ] {
        let host = format!("127.0.0.1:{}", page.port);
        let more = more.replace("Origin: ", &format!("Origin: http://{host}\r\n"));
        let (found, head, reported) =
            asked(&page, &format!("{method} {own}{path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n{more}\r\n{{"));
        let text = reported["error"].as_str().unwrap_or_default().to_lowercase();
        assert!(found == status && reported["code"] == "" && text.contains(what), "{method} {path}: {found} {reported}");
        assert!(head.contains("content-type: application/json") && head.contains("nosniff"), "{head}");
        assert!(status != 405 || head.contains("allow: get"), "{head}");
    }
}

#[test]
#[cfg(unix)]
fn pipes_and_links_to_devices_in_shown_folders_are_reported_and_keep_nobody_waiting() {
    let folder = results("view-pipes");
    let page = Page::open(&folder, &["view", "out"]);
    for (name, asked, wanted) in [
        ("fields/frame-00002.vtu", "frames/2", 404),
        ("fields/frame-00001.vtu", "probe?scalar=velocity&node=1", 422),
        // Times of frames stand in these, too.
        ("fields.pvd", "range?scalar=velocity", 200),
        ("history.csv", "history", 422),
        ("summary.json", "", 422),
        ("run.json", "", 422),
    ] {
        let path = folder.join("out").join(name);
        let bytes = fs::read(&path).unwrap();
        for is_device in [false, true] {
            fs::remove_file(&path).unwrap();
            if is_device {
                std::os::unix::fs::symlink("/dev/zero", &path).unwrap();
            } else {
                assert!(Command::new("mkfifo").arg(&path).status().unwrap().success());
            }
            let (status, reported) = page.own(format!("api/runs/0/{asked}").trim_end_matches('/'));
            let reported: serde_json::Value = serde_json::from_slice(&reported).unwrap();
            assert!(status == wanted && (status != 422 || reported["code"] == "E0708"), "{name}: {status} {reported}");
        }
        fs::remove_file(&path).unwrap();
        fs::write(&path, bytes).unwrap();
    }
}

#[test]
fn two_runs_are_shown_beside_each_other_and_one_that_can_not_be_read_says_why() {
    let folder = results("view-two");
    fs::create_dir_all(folder.join("broken/fields")).unwrap();
    fs::write(folder.join("broken/run.json"), "{").unwrap();
    let page = Page::open(&folder, &["view", "out", "broken"]);
    let runs: serde_json::Value = serde_json::from_slice(&page.own("api/runs").1).unwrap();
    assert!(runs["runs"][0]["name"] == "view-two" && runs["runs"][1]["fault"].as_str().unwrap().contains("run.json"), "{runs}");
}

#[test]
fn a_folder_without_results_and_a_short_token_are_refused() {
    let folder = results("view-refused");
    let reported = |arguments: &[&str]| {
        let answer = embate(&folder, arguments.iter().chain(&["--no-open"]));
        assert_eq!(answer.code, Some(2));
        answer.err
    };
    fs::create_dir(folder.join("empty")).unwrap();
    assert!(reported(&["view", "empty"]).contains("E0732"));
    assert!(reported(&["view", "nowhere"]).contains("there is no such folder"));
    assert!(reported(&["view", "out", "--token", "short"]).contains("E0821"));
    let page = Page::open(&folder, &["view", "out"]);
    assert!(reported(&["view", "out", "--port", &page.port.to_string()]).contains("choose another port"));
}

#[test]
fn a_run_that_is_watched_leaves_what_it_leaves_otherwise_and_its_page_ends_with_it() {
    let folder = fresh("view-watched");
    fs::write(folder.join("model.toml"), FLIGHT).unwrap();
    assert_eq!(embate(&folder, ["run", "model.toml", "--out", "alone", "--quiet"]).code, Some(0));
    let answer = embate(&folder, ["run", "model.toml", "--out", "watched", "--quiet", "--watch", "--no-open"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let address = answer.err.lines().find_map(|line| line.strip_prefix("page: http://")).unwrap();
    assert!(TcpStream::connect(address.split('/').next().unwrap()).is_err(), "nobody listens any more");
    for file in ["history.csv", "hashes.csv", "fields/frame-00004.vtu", "fields.pvd"] {
        assert!(fs::read(folder.join("alone").join(file)).unwrap() == fs::read(folder.join("watched").join(file)).unwrap(), "{file}");
    }
}

#[test]
fn a_page_that_is_kept_shows_the_results_when_the_run_is_over() {
    let folder = fresh("view-kept");
    fs::write(folder.join("model.toml"), FLIGHT).unwrap();
    let page = Page::open(&folder, &["run", "model.toml", "--out", "out", "--quiet", "--watch", "--keep"]);
    let over = (0..200).any(|_| {
        std::thread::sleep(Duration::from_millis(50));
        let run: serde_json::Value = serde_json::from_slice(&page.own("api/runs/0").1).unwrap();
        run["is_over"] == true && run["summary"]["status"] == "done"
    });
    assert!(over, "the run is over, and the page is there");
    assert_eq!(page.own("api/runs/0/frames/4").0, 200);
    let history: serde_json::Value = serde_json::from_slice(&page.own("api/runs/0/history").1).unwrap();
    assert_eq!(history["values"][0].as_array().unwrap().len(), 21);
    // Orders come by the socket alone, and that asks where one comes from.
    let upgrade = "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n";
    assert_eq!(page.get(&format!("/{}/api/live", page.token), upgrade).0, 403);
}

#[test]
fn a_model_is_shown_before_it_runs_and_followed_while_it_is_edited() {
    let folder = fresh("view-model");
    let file = folder.join("model.toml");
    fs::write(&file, FLIGHT).unwrap();
    let page = Page::open(&folder, &["view", "."]);
    let json = |path: &str| -> serde_json::Value {
        let (status, body) = page.own(path);
        assert_eq!(status, 200, "{path}: {}", String::from_utf8_lossy(&body));
        serde_json::from_slice(&body).unwrap()
    };
    let runs = json("api/runs");
    assert_eq!(
        (&runs["model"], &runs["runs"][0]["elements"], &runs["runs"][0]["frames"][0]["number"]),
        (&true.into(), &4.into(), &1.into())
    );
    let about = json("api/model");
    assert_eq!((&about["version"], about["faults"].as_array().unwrap().len(), &about["has_bodies"]), (&1.into(), 0, &true.into()));
    assert!(about["glyphs"].as_array().unwrap().iter().any(|glyph| glyph["kind"] == "velocity"), "{about}");
    for (path, status) in [
        ("api/runs/0/frames/1?scalar=stable_step", 200),
        ("api/runs/0/topology/0", 200),
        ("api/runs/0/topology/9", 404),
        ("api/runs/0/history", 200),
        ("api/runs/0/range?scalar=element_quality", 200),
        ("api/runs/0/probe?scalar=element_quality&cell=3", 200),
        ("api/runs/0/probe?scalar=element_quality&cell=4", 404),
        ("api/runs/1", 404),
        ("api/model?since=x", 400),
    ] {
        assert_eq!(page.own(path).0, status, "{path}");
    }
    // Each state of the file is one of the page, whatever it is.
    fs::write(&file, FLIGHT.replace("7800", "-7800")).unwrap();
    let faulty = json("api/model?since=1");
    assert_eq!((&faulty["version"], &faulty["has_bodies"]), (&2.into(), &true.into()));
    assert!(faulty["faults"][0]["line"].as_u64().unwrap() > 0 && faulty["faults"][0]["code"] == "E0110", "{}", faulty["faults"]);
    fs::write(&file, "run = {").unwrap();
    assert_eq!(json("api/model?since=2")["has_bodies"], false);
    fs::remove_file(&file).unwrap();
    assert_eq!(json("api/model?since=3")["faults"][0]["code"], "E0101");
    fs::write(&file, FLIGHT.replace("[2, 2]", "[4, 4]")).unwrap();
    let again = json("api/model?since=4");
    assert_eq!((&again["version"], again["faults"].as_array().unwrap().len()), (&5.into(), 0), "{again}");
    let run = json("api/runs/0");
    assert_eq!((&run["elements"], &run["frames"][0]["number"]), (&16.into(), &5.into()));
    drop(page);
    // A model is shown alone.
    let answer = embate(&folder, ["view", "model.toml", "out", "--no-open"]);
    assert!(answer.code == Some(2) && answer.err.contains("alone"), "{}", answer.err);
}
