//! A run in progress, shown to viewers: the topics of the log over a WebSocket that Foxglove and Lichtblick connect to.
//!
//! The server has threads of its own. Each viewer has a queue of 64 messages; where it is full, the oldest are dropped: a viewer
//! that is slow, or leaves, does not delay the run. Without a viewer nothing is computed.

use std::collections::BTreeMap;
use std::net::SocketAddr;
use std::sync::Arc;
use std::time::{Duration, Instant};

use foxglove::messages::{FrameTransforms, PointCloud, SceneUpdate};
use foxglove::websocket::Capability;
use foxglove::{Channel, Context, Encode, PartialMetadata, RawChannel, WebSocketServerHandle};
use run::log::{Frame, LogError, PROGRAM, Viewers, sample_message, sample_schema, stamp};

/// Shortest time between two pictures.
const INTERVAL: Duration = Duration::from_millis(80);
/// Messages that wait for a slow viewer: some five pictures.
const BACKLOG: usize = 64;

/// The server of a run.
pub struct LiveView {
    server: Option<WebSocketServerHandle>,
    context: Arc<Context>,
    fluid: Channel<PointCloud>,
    walls: Channel<PointCloud>,
    scene: Channel<SceneUpdate>,
    tf: Channel<FrameTransforms>,
    samples: BTreeMap<String, Arc<RawChannel>>,
    shown: Option<Instant>,
}

impl LiveView {
    /// Listen at an address; with port 0 the system chooses one.
    ///
    /// # Errors
    /// [`LogError::Live`] if the address cannot be had.
    pub fn start(address: SocketAddr, scene: &str) -> Result<LiveView, LogError> {
        let context = Context::new();
        let server = context
            .websocket_server()
            .name(format!("{PROGRAM} {scene}"))
            .bind(address.ip().to_string(), address.port())
            .capabilities([Capability::Time])
            .message_backlog_size(BACKLOG)
            .start_blocking()
            .map_err(|cause| LogError::Live(address, cause.to_string()))?;
        Ok(LiveView {
            server: Some(server),
            fluid: channel(&context, "/fluid"),
            walls: channel(&context, "/walls"),
            scene: channel(&context, "/scene"),
            tf: channel(&context, "/tf"),
            context,
            samples: BTreeMap::new(),
            shown: None,
        })
    }

    /// Port of the server.
    pub fn port(&self) -> u16 {
        self.server.as_ref().map_or(0, WebSocketServerHandle::port)
    }
}

impl Viewers for LiveView {
    fn is_due(&self) -> bool {
        let watched = self.server.as_ref().is_some_and(|server| server.client_count() > 0);
        watched && self.shown.is_none_or(|shown| shown.elapsed() >= INTERVAL)
    }

    fn sample(&mut self, time: f64, channel: &str, values: &[(&str, f64)]) -> Result<(), LogError> {
        let stamp = stamp(time)?;
        if !self.samples.contains_key(channel) {
            let topic = format!("/{channel}");
            let schema = sample_schema(&topic, values);
            let raw = self.context.channel_builder(topic).message_encoding("json").schema(schema).build_raw();
            // the encoding is given
            self.samples.extend(raw.ok().map(|raw| (channel.to_owned(), raw)));
        }
        if let Some(raw) = self.samples.get(channel) {
            raw.log_with_meta(&sample_message(values), PartialMetadata::with_log_time(stamp));
        }
        Ok(())
    }

    fn frame(&mut self, frame: &Frame) {
        self.shown = Some(Instant::now());
        if let Some(server) = &self.server {
            server.broadcast_time(frame.stamp.total_nanos());
        }
        self.fluid.log_with_time(&frame.fluid, frame.stamp);
        self.walls.log_with_time(&frame.walls, frame.stamp);
        self.scene.log_with_time(&frame.scene, frame.stamp);
        self.tf.log_with_time(&frame.tf, frame.stamp);
    }
}

impl Drop for LiveView {
    fn drop(&mut self) {
        if let Some(server) = self.server.take() {
            drop(server.stop());
        }
    }
}

fn channel<M: Encode>(context: &Arc<Context>, topic: &str) -> Channel<M> {
    context.channel_builder(topic).build()
}
