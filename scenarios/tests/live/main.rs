//! A run in progress is shown over a WebSocket, and does not depend on who looks.

use std::net::TcpStream;
use std::sync::LazyLock;
use std::sync::atomic::{AtomicU16, Ordering};
use std::time::{Duration, Instant};

use foxglove::Decode;
use foxglove::messages::PointCloud;
use run::log::Viewers;
use run::{RunOptions, run};
use scenarios::live::LiveView;
use scene::Scene;
use serde_json::Value;
use tungstenite::client::IntoClientRequest;
use tungstenite::{Message, WebSocket};

/// Bytes before the message: opcode, subscription, log time.
const HEADER: usize = 1 + 4 + 8;
/// Longest wait of a test.
const PATIENCE: Duration = Duration::from_secs(60);

fn wedge(time_end: &str) -> Scene {
    let sets = ["resolution.spacing=0.02", time_end, "compare=[]"].map(String::from);
    run::load("wedge", &sets).expect("a built-in scene").scene
}

/// A viewer that has subscribed to the fluid of a run.
fn viewer(port: u16) -> WebSocket<TcpStream> {
    let mut request = format!("ws://127.0.0.1:{port}").into_client_request().expect("an address");
    request.headers_mut().insert("sec-websocket-protocol", "foxglove.sdk.v1".parse().expect("a name"));
    let stream = TcpStream::connect(("127.0.0.1", port)).expect("a server");
    stream.set_read_timeout(Some(PATIENCE)).expect("a time");
    let (mut socket, _) = tungstenite::client(request, stream).expect("a handshake");
    let channel = loop {
        let Message::Text(text) = socket.read().expect("the channels") else { continue };
        let message: Value = serde_json::from_str(&text).expect("JSON");
        let channels = message["channels"].as_array().cloned().unwrap_or_default();
        if let Some(fluid) = channels.iter().find(|channel| channel["topic"] == "/fluid") {
            assert_eq!(fluid["schemaName"], "foxglove.PointCloud");
            break fluid["id"].clone();
        }
    };
    let subscribe = serde_json::json!({ "op": "subscribe", "subscriptions": [{ "id": 7, "channelId": channel }] });
    socket.send(Message::text(subscribe.to_string())).expect("a subscription");
    socket
}

/// The next picture of the fluid: log time [ns] and points.
fn picture(socket: &mut WebSocket<TcpStream>) -> Option<(u64, PointCloud)> {
    loop {
        let Message::Binary(data) = socket.read().ok()? else { continue };
        if data[0] != 1 {
            continue; // the clock
        }
        assert_eq!(u32::from_le_bytes(data[1..5].try_into().expect("4 bytes")), 7);
        let time = u64::from_le_bytes(data[5..HEADER].try_into().expect("8 bytes"));
        return Some((time, PointCloud::decode(&data[HEADER..]).expect("a point cloud")));
    }
}

/// Run a scene that `watch` sees; the rows of its series.
fn watched(scene: &Scene, watch: impl Fn(u16) + Sync) -> Vec<f64> {
    let port = AtomicU16::new(0);
    std::thread::scope(|threads| {
        let start = |scene: &Scene| {
            let view = LiveView::start(([127, 0, 0, 1], 0).into(), &scene.name)?;
            port.store(view.port(), Ordering::Release);
            Ok(Box::new(view) as Box<dyn Viewers>)
        };
        let options = RunOptions { live: Some(&start), ..RunOptions::default() };
        let watch = &watch;
        let port = &port;
        let viewer = threads.spawn(move || {
            let start = Instant::now();
            while port.load(Ordering::Acquire) == 0 {
                assert!(start.elapsed() < PATIENCE, "the server did not start");
                std::thread::sleep(Duration::from_millis(1));
            }
            watch(port.load(Ordering::Acquire));
        });
        let outcome = run(scene, &options).expect("a run");
        viewer.join().expect("a viewer");
        outcome.series.column("wedge.fy_N_per_m").expect("a force")
    })
}

/// The scene of two tests, and its series when nothing watches.
static ALONE: LazyLock<(Scene, Vec<f64>)> = LazyLock::new(|| {
    let scene = wedge("time.end=0.1");
    let outcome = run(&scene, &RunOptions::default()).expect("a run");
    (scene, outcome.series.column("wedge.fy_N_per_m").expect("a force"))
});

/// Pictures come in the order of time, carry all particles, and the run has the bits of one that nothing watches.
#[test]
fn a_viewer_sees_the_run_and_does_not_change_it() {
    let (scene, alone) = &*ALONE;
    let seen = watched(scene, |port| {
        let mut socket = viewer(port);
        let (mut last, mut pictures) = (0, 0);
        while let Some((time, cloud)) = picture(&mut socket) {
            assert!(time >= last, "{time} ns after {last} ns");
            assert_eq!(cloud.point_stride, 40);
            assert!(cloud.data.len() > 40 * 1000);
            (last, pictures) = (time, pictures + 1);
            if pictures == 3 {
                break; // the viewer leaves
            }
        }
        assert!(pictures > 0);
    });
    assert_eq!(&seen, alone);
}

/// A viewer that never reads does not hold the run up: it ends, with the same bits.
#[test]
fn a_viewer_that_stalls_does_not_disturb() {
    let (scene, alone) = &*ALONE;
    let stalled = std::sync::Mutex::new(None);
    let seen = watched(scene, |port| *stalled.lock().expect("a lock") = Some(viewer(port)));
    assert_eq!(&seen, alone);
}

#[test]
fn an_address_that_is_taken_is_refused_by_name() {
    let taken = std::net::TcpListener::bind("127.0.0.1:0").expect("a port");
    let address = taken.local_addr().expect("an address");
    let start = |scene: &Scene| Ok(Box::new(LiveView::start(address, &scene.name)?) as Box<dyn Viewers>);
    let options = RunOptions { live: Some(&start), ..RunOptions::default() };
    let error = run(&wedge("time.end=0.001"), &options).err().expect("an error");
    assert!(error.is_input());
    let error = error.to_string();
    assert!(error.contains(&address.to_string()) && error.contains("expected a free address"), "{error}");
}
