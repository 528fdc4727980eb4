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
mod held;
mod http;
mod outline;
mod page;
mod picture;
mod routes;
mod runs;
mod scene_view;
mod scratch;
mod shared;

use std::mem::take;
use std::net::{Ipv4Addr, TcpListener};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use flow::Flows;
use grid::Grids;
use guard::Guard;
use oxhttp::Server;
use oxhttp::model::{Body, HeaderValue, Request, Response, header};
use runs::Runs;
pub use shared::Options;
use shared::Shared;

/// Connections at the same time, at most: a thread each. Further ones wait.
const MOST_CONNECTIONS: usize = 256;
/// Longest wait for a piece of a request.
const PATIENCE: Duration = Duration::from_secs(10);
/// Longest wait for requests that are being answered at the end.
const LAST_ANSWERS: Duration = Duration::from_secs(2);
/// Pause between two looks for the end.
const PAUSE: Duration = Duration::from_millis(20);

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

/// A server of the page, until the process ends.
pub struct Studio {
    shared: Arc<Shared>,
}

impl Studio {
    /// Listen on the loopback address, and answer requests.
    ///
    /// # Errors
    /// The port cannot be had, or there are no random numbers.
    pub fn open(options: Options) -> Result<Studio, StudioError> {
        let wrong = |cause| StudioError::Port(options.port, cause);
        // the server does not say which port the system chose for it: a free one is looked for here, and left to it
        let free = TcpListener::bind((Ipv4Addr::LOCALHOST, options.port)).and_then(|listener| listener.local_addr());
        let own = free.map_err(wrong)?;
        let guard = Guard::new(own.port()).map_err(StudioError::Random)?;
        let (runs, flows, grids) = (Runs::new(&options.folder), Flows::default(), Grids::default());
        let shared = Arc::new(Shared { guard, options, runs, flows, grids });
        let of_server = Arc::clone(&shared);
        // each request that is being answered holds the shared parts once more
        let server = Server::new(move |request| answer(&Arc::clone(&of_server), request)).bind(own);
        let server = server.with_global_timeout(PATIENCE).with_max_concurrent_connections(MOST_CONNECTIONS);
        server.spawn().map_err(|cause| StudioError::Port(own.port(), cause))?;
        Ok(Studio { shared })
    }

    /// The address of the page, with its token.
    pub fn address(&self) -> String {
        self.shared.guard.address()
    }

    /// Run what the page asks for until `stop` is set; the run that goes on is then stopped and kept.
    pub fn serve(&self, stop: &AtomicBool) {
        thread::scope(|scope| {
            let worker = scope.spawn(|| self.shared.runs.work());
            while !stop.load(Ordering::Relaxed) {
                thread::sleep(PAUSE);
            }
            self.shared.flows.end();
            self.shared.grids.end();
            self.shared.runs.end();
            // a worker that broke down has nothing to keep
            let _ = worker.join();
        });
        let start = Instant::now();
        loop {
            // what is answered is sent meanwhile
            thread::sleep(PAUSE);
            // without a request, the studio and its server hold the shared parts
            if Arc::strong_count(&self.shared) <= 2 || start.elapsed() > LAST_ANSWERS {
                return;
            }
        }
    }
}

fn answer(shared: &Shared, request: &mut Request<Body>) -> Response<Body> {
    let (head, body) = take(request).into_parts();
    // what is left of a refused body is not read, and a connection that was answered holds no thread
    request.headers_mut().insert(header::CONNECTION, HeaderValue::from_static("close"));
    let body = shared.guard.admit(&head).and_then(|()| http::read(body));
    body.and_then(|body| routes::answer(shared, &head, &body)).unwrap_or_else(Response::from)
}
