//! The live page: its files, and pictures of scenes as fast as they can be drawn.
//!
//! A client is one WebSocket. It sends what it wants to see, whole, as JSON ([`asked`]); what it gets back is frames
//! ([`frame`]), coarse to fine, and facts and faults as JSON. Asynchronous threads only pass messages on: each client has a
//! thread of its own ([`painter`]) that draws in a pool which all share. No message names a file: scenes are that of the
//! command line, those shipped with the program, and keys set in them, of which those that hold paths are refused ([`stock`]).

mod asked;
mod assets;
mod client;
mod desk;
mod facts;
mod frame;
mod guard;
mod observation;
mod overlay;
mod pace;
mod painter;
mod saver;
mod stock;

use asked::View;
pub use guard::Guard;
pub use stock::Stock;

use std::io;
use std::net::{IpAddr, SocketAddr};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use axum::Router;
use axum::extract::State;
use axum::extract::ws::WebSocketUpgrade;
use axum::http::{StatusCode, Uri};
use axum::middleware;
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use kerrscope::render::{Props, Stage, Watch, draw};
use kerrscope::spacetime::Level;
use kerrscope_fit::models::Name;
use kerrscope_fit::request::unknown_model;
use rayon::ThreadPool;
use tokio::net::TcpListener;
use tokio::sync::Semaphore;

/// Clients at a time. A page has one, and one more while it compares.
const CLIENTS: usize = 16;

/// The largest message of a client, in bytes.
const MESSAGE: usize = 64 << 10;

/// How often the wish to stop is looked for.
const PATIENCE: Duration = Duration::from_millis(50);

/// What all clients share.
pub struct House {
    guard: Guard,
    stock: Stock,
    pool: ThreadPool,
    props: Props,
    seats: Arc<Semaphore>,
    saving: Semaphore,
    observing: Semaphore,
}

impl House {
    /// Draws a small picture of the scene given, so that its patterns are made and its code is in memory before a browser asks.
    fn rehearse(&self) {
        let view = View { size: [64, 36], samples: 1, ..View::default() };
        let Ok(scene) = self.stock.scene(&view, 1) else { return };
        self.pool.install(|| {
            if let Ok(stage) = Stage::with_props(&scene, Level::best(), &self.props) {
                let _ = draw(&stage, &Watch::default());
            }
        });
    }
}

/// Serves until asked to stop; `ready` is told the address once there is one.
///
/// # Errors
/// If the address cannot be had, or there are no threads.
pub fn serve(
    host: IpAddr,
    port: u16,
    token: Option<String>,
    stock: Stock,
    pool: ThreadPool,
    stop: &AtomicBool,
    ready: impl FnOnce(&str) -> io::Result<()>,
) -> io::Result<()> {
    let runtime = tokio::runtime::Builder::new_multi_thread().worker_threads(2).enable_all().build()?;
    let outcome = runtime.block_on(async {
        let listener = TcpListener::bind(SocketAddr::new(host, port)).await?;
        let guard = Guard::new(listener.local_addr()?, token);
        let address = guard.address();
        let house = Arc::new(House {
            guard,
            stock,
            pool,
            props: Props::default(),
            seats: Arc::new(Semaphore::new(CLIENTS)),
            saving: Semaphore::new(1),
            observing: Semaphore::new(1),
        });
        ready(&address)?;
        let first = Arc::clone(&house);
        tokio::task::spawn_blocking(move || first.rehearse());
        tokio::select! {
            served = axum::serve(listener, router(house)) => served,
            () = wish(stop) => Ok(()),
        }
    });
    // Painters end with their clients, and these with the runtime.
    runtime.shutdown_timeout(Duration::from_millis(500));
    outcome
}

async fn wish(stop: &AtomicBool) {
    while !stop.load(Ordering::Relaxed) {
        tokio::time::sleep(PATIENCE).await;
    }
}

fn router(house: Arc<House>) -> Router {
    let mut router = Router::new().route("/socket", get(socket)).route("/observation", get(observation));
    for asset in assets::ALL {
        router = router.route(asset.path, get(move || async move { asset.response() }));
    }
    router
        .fallback(|| async { (StatusCode::NOT_FOUND, "there is no such page\n") })
        .layer(middleware::from_fn_with_state(Arc::clone(&house), guard::check))
        .with_state(house)
}

/// Why there is no seat.
const FULL: &str = "as many pages are open as this program serves: close one\n";

/// A socket that takes a picture of anybody's. Its address may name the model: `?model=ring`.
async fn observation(State(house): State<Arc<House>>, uri: Uri, upgrade: WebSocketUpgrade) -> Response {
    let Ok(seat) = Arc::clone(&house.seats).try_acquire_owned() else {
        return (StatusCode::SERVICE_UNAVAILABLE, FULL).into_response();
    };
    let named = uri.query().and_then(|query| query.split('&').find_map(|part| part.strip_prefix("model=")));
    let model = match named.map(|text| Name::named(text).ok_or_else(|| unknown_model(text))).transpose() {
        Ok(model) => model,
        Err(fault) => return (StatusCode::BAD_REQUEST, format!("{fault}\n")).into_response(),
    };
    let upgrade = upgrade.max_message_size(observation::LARGEST).max_frame_size(observation::LARGEST);
    upgrade.on_upgrade(move |socket| async move {
        observation::serve(socket, house, model).await;
        drop(seat);
    })
}

async fn socket(State(house): State<Arc<House>>, upgrade: WebSocketUpgrade) -> Response {
    let Ok(seat) = Arc::clone(&house.seats).try_acquire_owned() else {
        return (StatusCode::SERVICE_UNAVAILABLE, FULL).into_response();
    };
    let upgrade = upgrade.max_message_size(MESSAGE).max_frame_size(MESSAGE);
    upgrade.on_upgrade(move |socket| async move {
        client::serve(socket, house).await;
        drop(seat);
    })
}
