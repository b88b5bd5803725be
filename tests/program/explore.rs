//! `alberti explore`: which requests the server answers or refuses, and whether it keeps running.

use crate::sandbox::Sandbox;
use alberti_tests::skip::report_skip;
use std::collections::{BTreeSet, VecDeque};
use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::net::{TcpListener, TcpStream};
use std::process::{Child, Command};
use std::time::{Duration, Instant};

/// A test server, which is killed when this value is dropped.
struct Server {
    child: Child,
    port: u16,
    /// The line that the server printed.
    address: String,
    /// The prefix of all paths: a slash and the token.
    base: String,
}

impl Server {
    fn start(sandbox: &Sandbox, arguments: &[&str]) -> Self {
        let mut child = sandbox.start(&[&["explore"], arguments].concat());
        let mut address = String::new();
        let stdout = child.stdout.as_mut().expect("a pipe");
        BufReader::new(stdout).read_line(&mut address).expect("a line");
        let port = address.split(':').nth(2).and_then(|rest| rest.split('/').next());
        let port = port.and_then(|port| port.parse().ok());
        let port = port.unwrap_or_else(|| panic!("no address: {address:?}"));
        let base = address.split('/').nth(3).map(|token| format!("/{token}")).expect("a token");
        Self { child, port, address: address.trim_end().to_owned(), base }
    }

    fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(("127.0.0.1", self.port)).expect("a connection");
        stream.set_read_timeout(Some(Duration::from_secs(60))).expect("a time limit");
        stream
    }

    /// Sends lines and returns the whole response, which is empty if the connection is dropped.
    fn send(&self, lines: &[&str]) -> String {
        let mut stream = self.connect();
        // The server may have closed the connection before reading everything.
        let _ = stream.write_all(format!("{}\r\n\r\n", lines.join("\r\n")).as_bytes());
        let mut bytes = Vec::new();
        let _ = stream.read_to_end(&mut bytes);
        String::from_utf8_lossy(&bytes).into_owned()
    }

    /// Returns the status and body of a GET request below the token, with the server's own host
    /// name.
    fn get(&self, target: &str) -> (u16, String) {
        self.get_path(&format!("{}{target}", self.base))
    }

    /// Returns the status and body of a GET request, with the server's own host name.
    fn get_path(&self, target: &str) -> (u16, String) {
        let host = format!("Host: 127.0.0.1:{}", self.port);
        let answer = self.send(&[&format!("GET {target} HTTP/1.1"), &host]);
        let (head, body) = answer.split_once("\r\n\r\n").unwrap_or((&answer, ""));
        (status(head), body.to_owned())
    }

    /// Sends a request below the token without reading the response.
    fn ask(&self, target: &str) -> TcpStream {
        let (mut stream, base, port) = (self.connect(), &self.base, self.port);
        let request = format!("GET {base}{target} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n\r\n");
        // The server may have closed the connection.
        let _ = stream.write_all(request.as_bytes());
        stream
    }

    /// Checks that a small query is answered as quickly as a user expects, even on a slow test
    /// machine.
    fn assert_answers_soon(&self, query: &str) {
        let start = Instant::now();
        assert_eq!(self.get(&format!("/compute?v=1&{query}")).0, 200);
        let seconds = start.elapsed().as_secs_f32();
        assert!(seconds < 5., "{query}: {seconds} s");
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        // It may already have exited.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Returns the status in the first line of a response, or 0 for a dropped connection.
fn status(response: &str) -> u16 {
    response.split(' ').nth(1).and_then(|status| status.parse().ok()).unwrap_or(0)
}

#[test]
fn the_page_its_modules_and_the_model_are_served() {
    let sandbox = Sandbox::new("explore_files");
    sandbox.copy_model("house.glb");
    let server = Server::start(&sandbox, &["house.glb"]);
    let (code, page) = server.get("/");
    assert_eq!(code, 200);
    assert!(page.contains("&quot;files&quot;:[&quot;house.glb&quot;]"), "{page}");
    for path in ["/main.js", "/style.css", "/worker.js", "/models/house.glb", "/files/house.glb"] {
        assert_eq!(server.get(path).0, 200, "{path}");
    }
    let (code, lessons) = server.get("/compute?v=1&what=lessons");
    assert_eq!(code, 200);
    let lessons: serde_json::Value = serde_json::from_str(&lessons).expect("JSON");
    let lessons = lessons["lessons"].as_array().expect("a list");
    for model in lessons.iter().flat_map(|lesson| lesson["models"].as_array().expect("models")) {
        let path = format!("/{}", model.as_str().expect("a path"));
        assert_eq!(server.get(&path).0, 200, "{path}");
    }
    let host = format!("Host: localhost:{}", server.port);
    let head = server.send(&[&format!("HEAD {}/ HTTP/1.1", server.base), &host]);
    assert!(head.starts_with("HTTP/1.1 200 OK\r\n") && head.ends_with("\r\n\r\n"), "{head}");
    let length = format!("\r\nContent-Length: {}\r\n", page.len());
    assert!(head.contains(&length), "{head}");
}

#[test]
fn a_copied_scene_works_in_an_empty_folder() {
    let sandbox = Sandbox::new("explore_copy");
    let server = Server::start(&sandbox, &[]);
    let (_, lessons) = server.get("/compute?v=1&what=lessons");
    let lessons: serde_json::Value = serde_json::from_str(&lessons).expect("JSON");
    let mut copied = 0;
    for lesson in lessons["lessons"].as_array().expect("a list") {
        let id = lesson["id"].as_str().expect("an id");
        let (_, state) = server.get(&format!("/compute?v=1&what=state&lesson={id}&size=32x20"));
        let state: serde_json::Value = serde_json::from_str(&state).expect("JSON");
        let Some(scene) = state["scene"].as_str() else { continue };
        sandbox.write_file("copied.ron", scene);
        let run = sandbox.run(&["render", "copied.ron", "--size=32x20", "-o", "copied.png"]);
        assert!(run.code == 0 && !run.stderr.contains("error"), "{id}: {}{scene}", run.stderr);
        copied += 1;
    }
    assert!(copied > 10, "{copied}");
    let check = sandbox.run(&["scene", "check", "copied.ron"]);
    assert!(check.code == 0 && check.stdout.contains("no mistakes"), "{}", check.stdout);
    sandbox.write_file("unknown.ron", "Scene(models: [(path: \"lesson:hous\")])");
    let unknown = sandbox.run(&["render", "unknown.ron", "-o", "unknown.png"]);
    assert!(unknown.code != 0 && unknown.stderr.contains("lesson:hous"), "{}", unknown.stderr);
}

/// Every formula id above a matrix is a link, and its page names the page of the book.
#[test]
fn every_formula_of_the_lessons_has_a_page() {
    let sandbox = Sandbox::new("explore_formulas");
    let server = Server::start(&sandbox, &[]);
    let (_, lessons) = server.get("/compute?v=1&what=lessons");
    let lessons: serde_json::Value = serde_json::from_str(&lessons).expect("JSON");
    let mut codes = BTreeSet::new();
    for lesson in lessons["lessons"].as_array().expect("lessons") {
        let id = lesson["id"].as_str().expect("an id");
        let (_, state) = server.get(&format!("/compute?v=1&what=state&lesson={id}&size=32x20"));
        let formulas =
            state.split("\"formula\":\"").skip(1).filter_map(|rest| rest.split('"').next());
        codes.extend(formulas.flat_map(|ids| ids.split(", ")).map(str::to_owned));
    }
    assert!(codes.len() > 5, "{codes:?}");
    for code in codes {
        let (status, page) = server.get(&format!("/reference/{code}"));
        assert_eq!(status, 200, "{code}");
        assert!(
            page.starts_with("<!DOCTYPE html>") && page.contains("<p>Book: "),
            "{code}: {page}"
        );
    }
    assert_eq!(server.get("/reference/unknown").0, 404);
}

#[test]
fn a_scene_is_explored_unchanged() {
    let sandbox = Sandbox::new("explore_scene");
    sandbox.copy_model("house.glb");
    let scene = r#"Scene(
        models: [Model(path: "house.glb")],
        camera: Camera(view: LookAt(eye: (0, 2, 12), target: (0, 2, 0))),
    )"#;
    sandbox.write_file("a.ron", scene);
    sandbox.write_file("empty.ron", "Scene()");
    sandbox.write_file("wrong.ron", "Scene(models: [Model(path: \"house.glb\")], camer: 1)");
    let server = Server::start(&sandbox, &["a.ron"]);
    assert_eq!((server.get("/files/house.glb").0, server.get("/files/a.ron").0), (200, 200));
    let (_, state) = server.get("/compute?v=1&what=state&lesson=scene&model=a.ron&size=64x40");
    let state: serde_json::Value = serde_json::from_str(&state).expect("JSON");
    assert_eq!(state["scene"].as_str(), Some(scene), "{state}");
    let command = state["command"].as_str().expect("a command").trim();
    assert_eq!(command, "alberti render 'a.ron' --size 64x40 --samples 4");
    // The scene's eye, in the camera step.
    assert_eq!(
        state["matrix"]["steps"][0]["items"][0]["value"],
        serde_json::json!([0.0, 2.0, 12.0])
    );
    for (name, words) in [("empty.ron", "a scene needs"), ("wrong.ron", "camer")] {
        let run = sandbox.run(&["explore", name]);
        assert!(run.code == 1 && run.stderr.contains(words), "{}", run.stderr);
    }
}

#[test]
fn request_errors_are_answered() {
    let sandbox = Sandbox::new("explore_errors");
    let server = Server::start(&sandbox, &[]);
    let (code, error) = server.get("/compute?v=1&what=state&naer=2");
    let error: serde_json::Value = serde_json::from_str(&error).expect("JSON");
    assert_eq!((code, error["code"].as_str()), (200, Some("unknown_key")), "{error}");
    assert!(error["message"].as_str().is_some_and(|text| text.contains("naer")), "{error}");
    assert_eq!(server.get("/compute?v=1&what=lessons").0, 200);
}

#[test]
fn foreign_pages_host_names_and_methods_are_refused() {
    let sandbox = Sandbox::new("explore_foreign");
    let server = Server::start(&sandbox, &[]);
    let own = format!("Host: 127.0.0.1:{}", server.port);
    let first = "GET / HTTP/1.1";
    let refused = |lines: &[&str], expected: u16| {
        assert_eq!(status(&server.send(lines)), expected, "{lines:?}");
    };
    refused(&[first, "Host: a.example"], 421);
    refused(&[first, &format!("Host: a.example:{}", server.port)], 421);
    refused(&[first], 421);
    refused(&[first, &own, "Origin: http://a.example"], 403);
    refused(&[first, &own, "Sec-Fetch-Site: cross-site"], 403);
    for method in ["POST", "PUT", "DELETE", "OPTIONS", "TRACE", "PATCH"] {
        refused(&[&format!("{method} / HTTP/1.1"), &own, "Content-Length: 0"], 405);
    }
    refused(&["nonsense"], 400);
    assert_eq!(server.get("/").0, 200);
}

#[test]
fn nothing_is_served_without_the_token() {
    let sandbox = Sandbox::new("explore_token");
    sandbox.copy_model("house.glb");
    let server = Server::start(&sandbox, &["house.glb"]);
    let token = server.base.trim_start_matches('/');
    assert!(token.len() == 32 && token.bytes().all(|digit| digit.is_ascii_hexdigit()), "{token}");
    let zeros = "0".repeat(32);
    for base in ["", "/", &format!("/{zeros}"), &server.base[..32], &format!("{}0", server.base)] {
        for path in ["/", "/main.js", "/files/house.glb", "/compute?v=1&what=lessons"] {
            let (code, body) = server.get_path(&format!("{base}{path}"));
            assert_eq!(code, 403, "{base}{path}");
            assert!(body.contains("address that `alberti explore` printed"), "{body}");
        }
    }
    assert_eq!(server.get_path(&server.base).0, 403, "the slash is part of the address");
    let other = Server::start(&sandbox, &[]);
    assert_ne!(other.base, server.base);
}

#[test]
fn slow_readers_and_abandoned_pictures_do_not_stop_the_server() {
    let sandbox = Sandbox::new("explore_slow");
    let gltf = r#"{"asset":{"version":"2.0"},"buffers":[{"uri":"a.bin","byteLength":36},
        {"uri":"large.bin","byteLength":16777216}],
        "bufferViews":[{"buffer":0,"byteLength":36}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",
        "min":[0,0,0],"max":[1,1,0]}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0}"#;
    sandbox.write_file("a.gltf", gltf);
    let corners = [[0f32, 0., 0.], [1., 0., 0.], [0., 1., 0.]];
    let bytes: Vec<u8> = corners.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect();
    sandbox.write_file("a.bin", bytes);
    sandbox.write_file("large.bin", vec![0; 16 << 20]);
    let server = Server::start(&sandbox, &["a.gltf"]);
    // These requests total more bytes than the server holds at once, and no client reads them.
    let _slow: Vec<TcpStream> = (0..500).map(|_| server.ask("/files/large.bin")).collect();
    server.assert_answers_soon("what=state&lesson=frustum");
    // Each picture takes most of a minute.
    let picture = "/compute?v=1&lesson=frustum&what=picture&size=8192x8192";
    let waiting = server.ask(picture);
    for _ in 0..50 {
        drop(server.ask(picture));
    }
    server.assert_answers_soon("what=state&lesson=frustum");
    drop(waiting);
    server.assert_answers_soon("what=picture&lesson=frustum&size=64x40");
}

#[test]
fn no_path_leads_out_of_the_served_files() {
    let sandbox = Sandbox::new("explore_paths");
    sandbox.write_file("secret.txt", "secret");
    std::fs::create_dir(sandbox.path_of("models")).expect("a folder");
    let gltf = r#"{"asset":{"version":"2.0"},"buffers":[{"uri":"a.bin","byteLength":36},
        {"uri":"../secret.txt","byteLength":6},{"uri":"link.bin","byteLength":6}],
        "bufferViews":[{"buffer":0,"byteLength":36}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",
        "min":[0,0,0],"max":[1,1,0]}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0}"#;
    sandbox.write_file("models/a.gltf", gltf);
    let corners = [[0f32, 0., 0.], [1., 0., 0.], [0., 1., 0.]];
    let bytes: Vec<u8> = corners.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect();
    sandbox.write_file("models/a.bin", bytes);
    #[cfg(unix)]
    std::os::unix::fs::symlink("../secret.txt", sandbox.path_of("models/link.bin"))
        .expect("a link");
    // No accessor reads the other two buffers, so the model is shown without them.
    let server = Server::start(&sandbox, &["models/a.gltf"]);
    assert_eq!(server.get("/files/a.bin").0, 200);
    let hidden = [
        "/files/../secret.txt",
        "/../secret.txt",
        "/files/%2e%2e/secret.txt",
        "/%2e%2e%2fsecret.txt",
        "/files/..%5csecret.txt",
        "/files/link.bin",
        "/files/..%2fsecret.txt",
        "/files//etc/passwd",
        "//etc/passwd",
        "/secret.txt",
        "/models/a.gltf",
        "/files/",
        "/models/",
    ];
    for target in hidden {
        let (code, body) = server.get(target);
        assert_eq!(code, 404, "{target}");
        assert!(!body.contains("secret\n"), "{target}");
    }
}

#[test]
fn a_one_megabyte_header_is_refused() {
    let sandbox = Sandbox::new("explore_header");
    let server = Server::start(&sandbox, &[]);
    let long = format!("X: {}", "a".repeat(1 << 20));
    let answer = server.send(&["GET / HTTP/1.1", &long]);
    assert!(matches!(status(&answer), 0 | 431), "{answer}");
    assert_eq!(server.get("/").0, 200);
}

#[test]
fn a_thousand_silent_connections_do_not_stop_the_server() {
    let sandbox = Sandbox::new("explore_silent");
    let server = Server::start(&sandbox, &[]);
    let mut silent = VecDeque::new();
    for _ in 0..1000 {
        silent.push_back(server.connect());
        // All tests together may have a thousand open files, because they share a process.
        if silent.len() > 300 {
            let mut oldest = silent.pop_front().expect("the oldest");
            assert!(matches!(oldest.read(&mut [0]), Ok(0) | Err(_)), "it is still open");
        }
    }
    assert_eq!(server.get("/").0, 200);
    assert_eq!(server.get("/compute?v=1&what=lessons").0, 200);
}

#[cfg(unix)]
#[test]
fn an_interrupt_stops_the_server() {
    use std::os::unix::process::ExitStatusExt as _;
    // A shell starts background commands with interrupts ignored, and their child processes inherit
    // this setting.
    if ignores_signal(2) {
        return report_skip(
            "an_interrupt_stops_the_server",
            "this test was started with interrupts ignored",
        );
    }
    let sandbox = Sandbox::new("explore_interrupt");
    let mut server = Server::start(&sandbox, &["--native"]);
    let end = format!("{}/?native", server.base);
    assert!(server.address.ends_with(&end), "{}", server.address);
    let _open = server.connect();
    let process = server.child.id().to_string();
    let kill = Command::new("kill").args(["-INT", &process]).status().expect("kill");
    assert!(kill.success());
    // As in the other commands, the signal ends the program; there is nothing to clean up.
    let status = server.child.wait().expect("the process exits");
    assert_eq!(status.signal(), Some(2), "{status}");
}

/// Returns whether this process ignores a signal, according to the signal's bit in its mask.
#[cfg(unix)]
pub(crate) fn ignores_signal(number: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_some_and(|mask| mask & (1 << (number - 1)) != 0)
}

#[test]
fn ports_in_use_and_broken_models_are_reported() {
    let sandbox = Sandbox::new("explore_refused");
    let taken = TcpListener::bind("127.0.0.1:0").expect("a port");
    let port = taken.local_addr().expect("the port is bound").port().to_string();
    let run = sandbox.run(&["explore", "--port", &port]);
    let expected = format!("error: cannot listen on 127.0.0.1:{port}: ");
    assert!(run.code == 1 && run.stderr.starts_with(&expected), "{}", run.stderr);
    assert!(run.stderr.contains("  = help: choose another --port"), "{}", run.stderr);
    assert_eq!(sandbox.run(&["explore", "--port", "0"]).code, 2);
    sandbox.write_file("broken.glb", b"glTF\x02\0\0\0\xff\xff\xff\xff");
    sandbox.write_file("words.txt", "no model");
    for name in ["broken.glb", "words.txt", "missing.glb", "."] {
        let run = sandbox.run(&["explore", name]);
        assert!(run.code == 1 && run.stderr.starts_with("error: "), "{name}: {}", run.stderr);
        assert_eq!(run.stdout, "", "{name}");
    }
}
