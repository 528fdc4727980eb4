//! `splashdown studio` over its HTTP interface, as a browser and as others would ask it.

mod asked;
mod refused;

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value;
use temp_dir::TempDir;

/// Longest wait for anything.
const PATIENCE: Duration = Duration::from_secs(60);

/// A studio in a folder of its own.
struct Studio {
    process: Child,
    folder: TempDir,
    host: String,
    token: String,
}

impl Drop for Studio {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// An answer: status, headers, body.
struct Answer {
    status: u16,
    head: String,
    body: String,
}

impl Studio {
    /// Opened with these arguments.
    fn open(arguments: &[&str]) -> Studio {
        let folder = TempDir::new().expect("a temporary folder");
        let mut command = Command::new(env!("CARGO_BIN_EXE_splashdown"));
        command.arg("studio").args(arguments).args(["--no-browser", "--json", "--dir"]).arg(folder.path());
        command.stdout(Stdio::piped()).stderr(Stdio::null());
        let mut process = command.spawn().expect("the program");
        let text = object(&mut BufReader::new(process.stdout.take().expect("its output")));
        let said: Value = serde_json::from_str(&text).expect("JSON");
        let address = said["address"].as_str().expect("an address").strip_prefix("http://").expect("HTTP");
        let (host, token) = address.split_once("/?token=").expect("a token");
        Studio { process, folder, host: host.into(), token: token.into() }
    }

    fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(&self.host).expect("the studio listens");
        stream.set_read_timeout(Some(PATIENCE)).expect("a time limit");
        stream
    }

    /// A request as it stands.
    fn raw(&self, request: &str) -> Answer {
        let mut stream = self.connect();
        stream.write_all(request.as_bytes()).expect("the studio reads");
        read(&mut stream)
    }

    /// A request with the host and these headers.
    fn with(&self, line: &str, headers: &[(&str, &str)], body: &str) -> Answer {
        let headers: String = headers.iter().map(|(name, value)| format!("{name}: {value}\r\n")).collect();
        self.raw(&format!(
            "{line} HTTP/1.1\r\nHost: {}\r\n{headers}Content-Length: {}\r\n\r\n{body}",
            self.host,
            body.len()
        ))
    }

    fn get(&self, path: &str) -> Answer {
        self.with(&format!("GET {path}"), &[("X-Splashdown-Token", &self.token)], "")
    }

    /// JSON for JSON.
    fn post(&self, path: &str, body: &Value) -> Value {
        let answer = self.with(&format!("POST {path}"), &[("X-Splashdown-Token", &self.token)], &body.to_string());
        assert_eq!(answer.status, 200, "{path}: {}", answer.body);
        serde_json::from_str(&answer.body).expect("JSON")
    }

    fn json(&self, path: &str) -> Value {
        let answer = self.get(path);
        assert_eq!(answer.status, 200, "{path}: {}", answer.body);
        serde_json::from_str(&answer.body).expect("JSON")
    }

    /// The text at the start.
    fn text(&self) -> String {
        self.json("/api/start")["text"].as_str().expect("a text").to_string()
    }

    /// Wait until the list of runs has one that is so.
    fn wait(&self, is: impl Fn(&Value) -> bool) -> Value {
        let start = Instant::now();
        loop {
            let list = self.json("/api/runs");
            if let Some(run) = list.as_array().expect("a list").iter().find(|run| is(run)) {
                return run.clone();
            }
            assert!(start.elapsed() < PATIENCE, "{list}");
            std::thread::sleep(Duration::from_millis(50));
        }
    }
}

/// The lines of a JSON object, printed over several; what follows is not waited for.
fn object(output: &mut impl BufRead) -> String {
    let mut text = String::new();
    while !text.ends_with("}\n") && output.read_line(&mut text).is_ok_and(|count| count > 0) {}
    text
}

/// The answer that a connection has.
fn read(stream: &mut TcpStream) -> Answer {
    let mut bytes = Vec::new();
    // a connection that is cut after the answer still has it
    let _ = stream.read_to_end(&mut bytes);
    let text = String::from_utf8_lossy(&bytes).into_owned();
    let (head, body) = text.split_once("\r\n\r\n").unwrap_or((&text, ""));
    let status = head.split(' ').nth(1).and_then(|status| status.parse().ok()).unwrap_or(0);
    Answer { status, head: head.into(), body: body.into() }
}

/// A wedge that theories follow.
fn wedge() -> String {
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("scene/scenes/wedge.toml");
    std::fs::read_to_string(scene).expect("a built-in scene")
}
