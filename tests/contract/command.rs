//! The built command, run in a folder of its own.

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::sync::LazyLock;
use std::time::{Duration, Instant, SystemTime};
use std::{env, fs, thread};

use serde_json::Value;
use temp_dir::TempDir;

/// Longest wait for anything [s].
const PATIENCE: Duration = Duration::from_secs(60);

/// The binary near this test's own, as cargo lays them out: `TARGET/PROFILE/deps/TEST` and `TARGET/PROFILE/splashdown`.
pub fn binary() -> &'static Path {
    static FOUND: LazyLock<PathBuf> = LazyLock::new(find);
    &FOUND
}

fn find() -> PathBuf {
    let test = env::current_exe().expect("a test has a path");
    let profile = test.parent().and_then(Path::parent).expect("TARGET/PROFILE/deps");
    let path = profile.join(format!("splashdown{}", env::consts::EXE_SUFFIX));
    let built = fs::metadata(&path).and_then(|m| m.modified());
    let built =
        built.unwrap_or_else(|e| panic!("{}: {e}; run `cargo build --workspace` for this profile", path.display()));
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the workspace");
    for crate_ in ["sph_core", "fsi_coupling", "scenarios"] {
        let (file, changed) = newest(&root.join(crate_).join("src"));
        let older = format!("{} is older than {}", path.display(), file.display());
        assert!(changed <= built, "{older}; run `cargo build --workspace` for this profile");
    }
    path
}

/// The file below a folder that was changed last.
fn newest(folder: &Path) -> (PathBuf, SystemTime) {
    let entries = fs::read_dir(folder).expect("a folder of sources").map(|e| e.expect("an entry").path());
    let dated = entries.map(|path| match path.is_dir() {
        true => newest(&path),
        false => (path.clone(), fs::metadata(&path).and_then(|m| m.modified()).expect("a date")),
    });
    dated.max_by_key(|(_, date)| *date).unwrap_or((folder.to_path_buf(), SystemTime::UNIX_EPOCH))
}

/// A folder to run in, gone with the value.
pub struct Workplace {
    folder: TempDir,
}

impl Workplace {
    pub fn new() -> Workplace {
        Workplace { folder: TempDir::new().expect("a temporary folder") }
    }

    /// A path in the folder.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// A file's bytes.
    pub fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    /// A file as text.
    pub fn text(&self, name: &str) -> String {
        String::from_utf8(self.read(name)).expect("text")
    }

    /// The `summary.json` of the run in a folder.
    pub fn summary(&self, out: &str) -> Value {
        serde_json::from_str(&self.text(&format!("{out}/summary.json"))).expect("JSON")
    }

    /// The command, not started.
    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(binary());
        command.args(arguments).current_dir(self.folder.path()).stdin(Stdio::null());
        command
    }

    /// Run to the end.
    pub fn run(&self, arguments: &[&str]) -> Ended {
        Ended::from(self.command(arguments).output().expect("the command starts"))
    }

    /// Start, and come back once `file` holds more than `bytes` [bytes].
    pub fn start_until(&self, arguments: &[&str], file: &str, bytes: u64) -> Child {
        let mut command = self.command(arguments);
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the command starts");
        let (path, start) = (self.path(file), Instant::now());
        while fs::metadata(&path).map_or(0, |m| m.len()) <= bytes {
            let ended = child.try_wait().expect("a child to wait for");
            assert!(ended.is_none(), "the run ended ({ended:?}) before {file} had {bytes} bytes");
            assert!(start.elapsed() < PATIENCE, "{file} has not grown to {bytes} bytes in {PATIENCE:?}");
            thread::sleep(Duration::from_millis(5));
        }
        child
    }
}

/// How a command ended.
pub struct Ended {
    /// Exit code; `None` if a signal ended it.
    pub code: Option<i32>,
    /// What it printed on stderr, without the frames and line breaks that are there for reading.
    pub message: String,
    /// What it printed on stdout.
    pub stdout: String,
}

impl From<Output> for Ended {
    fn from(output: Output) -> Ended {
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        let bare: String = text.chars().map(|c| if "│╭╰─×·├▶".contains(c) { ' ' } else { c }).collect();
        let message = bare.split_whitespace().collect::<Vec<_>>().join(" ");
        Ended { code: output.status.code(), message, stdout: String::from_utf8_lossy(&output.stdout).into_owned() }
    }
}

impl Ended {
    /// Assert that every fragment is in the message.
    pub fn says(&self, fragments: &[&str]) {
        for fragment in fragments {
            assert!(self.message.contains(fragment), "{fragment:?} is not in: {}", self.message);
        }
    }
}

/// What a log holds for a reader that stops where the file does.
pub struct Log {
    /// Messages on `/fluid`.
    pub fluid_frames: usize,
    /// Notes on `/log`, as the bytes of their messages.
    pub notes: Vec<Vec<u8>>,
    /// True if the file ends as a finished log does, with its summary.
    pub complete: bool,
}

/// Read a log that may be cut off, with a reader that needs no summary.
pub fn read_log(bytes: &[u8]) -> Log {
    let complete = matches!(mcap::Summary::read(bytes), Ok(Some(_)));
    let options = mcap::sans_io::LinearReaderOptions::default().with_skip_end_magic(true);
    let mut log = Log { fluid_frames: 0, notes: Vec::new(), complete };
    for message in mcap::io::MessageReader::new_with_options(bytes, options).map_while(Result::ok) {
        match message.channel.topic.as_str() {
            "/fluid" => log.fluid_frames += 1,
            "/log" => log.notes.push(message.data.to_vec()),
            _ => {}
        }
    }
    log
}
