//! A page on this machine: a scene is edited, computed by theories as one types, run, and compared.
//!
//! [`Studio::open`] listens on the loopback address, [`Studio::serve`] answers until it is ended. Each request needs the token of the address
//! ([`Studio::address`]), the host and the origin of the page. Nothing is loaded from elsewhere, and nothing outside the studio's folder is read
//! or written but scratch files of the system's temporary folder.

mod answers;
mod edit;
mod flow;
mod grid;
mod guard;
mod http;
mod options;
mod outline;
mod page;
mod picture;
mod routes;
mod runs;
mod scene_view;
mod scratch;
mod shared;

use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use flow::Flows;
use grid::Grids;
use guard::Guard;
use http::{Answer, Refusal, read_body, read_head};
pub use options::Options;
use runs::Runs;
use shared::Shared;

/// Requests that are answered at the same time, at most.
const MOST_REQUESTS: usize = 64;
/// Longest wait for a piece of a request.
const PATIENCE: Duration = Duration::from_secs(10);
/// Longest wait for requests that are being answered at the end.
const LAST_ANSWERS: Duration = Duration::from_secs(2);
/// Pause between two looks for a request.
const PAUSE: Duration = Duration::from_millis(5);

/// Why a studio cannot be opened.
#[derive(Debug, thiserror::Error)]
pub enum StudioError {
    /// The port cannot be had.
    #[error("cannot listen on port {0}: {1}")]
    Port(u16, std::io::Error),
    /// The system has no random numbers for the token.
    #[error("no random numbers: {0}")]
    Random(getrandom::Error),
}

/// A server of the page.
pub struct Studio {
    listener: TcpListener,
    shared: Arc<Shared>,
}

impl Studio {
    /// Listen on the loopback address.
    ///
    /// # Errors
    /// The port cannot be had, or there are no random numbers.
    pub fn open(options: Options) -> Result<Studio, StudioError> {
        let port = options.port;
        let wrong = |cause| StudioError::Port(port, cause);
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port)).map_err(wrong)?;
        listener.set_nonblocking(true).map_err(wrong)?;
        let own = listener.local_addr().map_err(wrong)?.port();
        let guard = Guard::new(own).map_err(StudioError::Random)?;
        let (runs, flows, grids) = (Runs::new(&options.folder), Flows::default(), Grids::default());
        let shared = Shared { guard, options, runs, flows, grids };
        Ok(Studio { listener, shared: Arc::new(shared) })
    }

    /// The address of the page, with its token.
    pub fn address(&self) -> String {
        self.shared.guard.address()
    }

    /// Answer requests until `stop` is set; the run that goes on is then stopped and kept.
    pub fn serve(&self, stop: &AtomicBool) {
        let worker = {
            let shared = Arc::clone(&self.shared);
            thread::spawn(move || shared.runs.work())
        };
        let open = Arc::new(AtomicUsize::new(0));
        while !stop.load(Ordering::Relaxed) {
            let Ok((mut stream, _)) = self.listener.accept() else {
                thread::sleep(PAUSE);
                continue;
            };
            let (shared, open) = (Arc::clone(&self.shared), Arc::clone(&open));
            if open.load(Ordering::Relaxed) >= MOST_REQUESTS {
                Answer::from(Refusal::new(503, "too many requests at the same time")).send(&mut stream);
                continue;
            }
            open.fetch_add(1, Ordering::Relaxed);
            thread::spawn(move || {
                let _open = Open(open);
                answer(&shared, &mut stream);
            });
        }
        self.shared.flows.end();
        self.shared.grids.end();
        self.shared.runs.end();
        // a worker that broke down has nothing to keep
        let _ = worker.join();
        let start = Instant::now();
        while open.load(Ordering::Relaxed) > 0 && start.elapsed() < LAST_ANSWERS {
            thread::sleep(PAUSE);
        }
    }
}

/// Counts a request until it is answered, or its thread breaks down.
struct Open(Arc<AtomicUsize>);

impl Drop for Open {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}

fn answer(shared: &Shared, stream: &mut TcpStream) {
    let ready = stream.set_nonblocking(false).and_then(|()| stream.set_read_timeout(Some(PATIENCE)));
    if ready.and_then(|()| stream.set_write_timeout(Some(PATIENCE))).is_err() {
        return;
    }
    let answer = match read_head(stream) {
        Ok(None) => return,
        Ok(Some(head)) => shared
            .guard
            .admit(&head)
            .and_then(|()| read_body(&head, stream))
            .and_then(|body| routes::answer(shared, &head, &body)),
        Err(refusal) => Err(refusal),
    };
    answer.unwrap_or_else(Answer::from).send(stream);
}
