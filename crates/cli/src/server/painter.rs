//! Draws what a client wants to see, coarse to fine, until it wants something else.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

use kerrscope::render::{Stage, Watch, draw};
use kerrscope::scene::{Engine, Scene};
use kerrscope::spacetime::Level;
use tokio::sync::mpsc::Sender;

use super::House;
use super::asked::View;
use super::client::Sent;
use super::desk::Desk;
use super::facts::{Facts, Notice, Progress};
use super::frame::{self, Label};
use super::overlay::{self, Kind};
use super::pace::{Pace, divided};

/// A frame in motion is finished although there is news, or none ever would be; but not if it takes longer than this.
const OVERDUE: Duration = Duration::from_millis(200);

/// If the last picture is expected to take longer than this, a finer one than that in motion is shown before.
const LONG: f64 = 1.0;

/// How often it is told how far a picture is, milliseconds.
const TOLD: u64 = 500;

/// Why no more is drawn.
enum End {
    /// Something newer is wanted.
    News,
    /// There is nobody.
    Gone,
    /// It cannot be drawn, for this reason.
    Fault(String),
}

/// The painter of a client.
pub struct Painter {
    house: Arc<House>,
    desk: Arc<Desk>,
    send: Sender<Sent>,
    pace: Pace,
}

impl Painter {
    pub fn new(house: Arc<House>, desk: Arc<Desk>, send: Sender<Sent>) -> Self {
        Self { house, desk, send, pace: Pace::default() }
    }

    /// Draws until the desk is closed.
    pub fn run(mut self) {
        while let Some(view) = self.desk.take() {
            let painted = catch_unwind(AssertUnwindSafe(|| self.show(&view)));
            let fault = match painted {
                Ok(Ok(()) | Err(End::News)) => continue,
                Ok(Err(End::Gone)) => return,
                Ok(Err(End::Fault(fault))) => fault,
                Err(_) => "a fault of kerrscope itself, please report it with the page's address".to_owned(),
            };
            let refusal = super::stock::Refusal::Wish(fault);
            if self.tell(&Notice::refusal(view.generation, &refusal)).is_err() {
                return;
            }
        }
    }

    fn tell(&self, notice: &Notice) -> Result<(), End> {
        self.send.blocking_send(Sent::Text(notice.json())).map_err(|_| End::Gone)
    }

    fn show(&mut self, view: &View) -> Result<(), End> {
        let scene = match self.house.stock.scene(view, view.samples) {
            Ok(mut scene) => {
                // A legend below the picture would move everything in it.
                if let Some(layer) = &mut scene.display.layer {
                    layer.legend = false;
                }
                scene
            }
            Err(refusal) => return self.tell(&Notice::refusal(view.generation, &refusal)),
        };
        let kind = kind(&scene);
        let pixels = f64::from(view.size[0]) * f64::from(view.size[1]);
        let divisor = self.pace.motion(&kind, pixels);
        self.paint(view, &coarser(&scene, divisor), &kind, view.moving, false)?;
        let quick = scene.render.engine == Engine::ClosedForm;
        if quick {
            self.overlay(view, &scene)?;
        }
        if view.moving {
            return Ok(());
        }
        // Nothing says how long an interpolated picture takes before there was one.
        let whole = format!("{kind}, whole");
        let rays = pixels * f64::from(view.samples);
        if divisor > 2.0 && self.pace.seconds(&whole, rays) > LONG {
            self.paint(view, &coarser(&scene, 2.0), &kind, false, false)?;
        }
        self.paint(view, &scene, &whole, false, true)?;
        if quick { Ok(()) } else { self.overlay(view, &scene) }
    }

    /// Sends the lines over a picture; in motion the shadow's edge alone, the others being gone before they are seen.
    fn overlay(&self, view: &View, scene: &Scene) -> Result<(), End> {
        let wanted = |kind: &Kind| !view.moving || *kind == Kind::Critical;
        let kinds: Vec<Kind> = view.overlays.iter().copied().filter(wanted).collect();
        if view.overlays.is_empty() {
            return Ok(());
        }
        let lines = self.house.pool.install(|| overlay::lines(scene, &kinds));
        self.tell(&Notice::Overlay { generation: view.generation, lines })
    }

    /// Draws one picture and sends it.
    fn paint(
        &mut self,
        view: &View,
        scene: &Scene,
        kind: &str,
        hurried: bool,
        last: bool,
    ) -> Result<(), End> {
        let begin = Instant::now();
        let house = Arc::clone(&self.house);
        let desk = Arc::clone(&self.desk);
        let stage = house.pool.install(|| Stage::with_props(scene, Level::best(), &house.props));
        let stage = stage.map_err(|e| End::Fault(e.to_string()))?;
        if last || hurried {
            let mut facts = Facts::of(view.generation, scene, stage.engine());
            facts.generation = view.generation;
            self.tell(&Notice::Facts(Box::new(facts)))?;
        }
        let ready = Instant::now();
        let stop = AtomicBool::new(desk.is_closed());
        let total = stage.rays();
        let (done, told) = (AtomicU64::new(0), AtomicU64::new(0));
        let look = |rays| {
            let done = done.fetch_add(rays, Ordering::Relaxed) + rays;
            let waited = ready.elapsed().as_millis() as u64;
            let before = told.load(Ordering::Relaxed);
            let due = !hurried && waited >= before + TOLD;
            if due && told.compare_exchange(before, waited, Ordering::Relaxed, Ordering::Relaxed).is_ok() {
                let progress = Progress { generation: view.generation, done, total };
                // Where the client is slow, this is not what it has to hear.
                let _ = self.send.try_send(Sent::Text(Notice::Drawing(progress).json()));
            }
            let out_of_date = desk.has_newer() && (!hurried || ready.elapsed() > OVERDUE || desk.is_closed());
            if out_of_date {
                stop.store(true, Ordering::Relaxed);
            }
        };
        look(0);
        let watch = Watch { cancelled: &stop, progress: &look, checkpoint: None };
        let film = house.pool.install(|| draw(&stage, &watch)).map_err(|_| End::News)?;
        let rays = stage.rays() as f64;
        let drawn = ready.elapsed().as_secs_f64();
        if last {
            let key =
                house.pool.install(|| scene.display.layer.as_ref().map(|layer| layer.key(&film).into()));
            self.tell(&Notice::Key { generation: view.generation, key })?;
        }
        let bytes = house.pool.install(|| {
            let picture = scene.display.picture(&film);
            let label = Label {
                generation: view.generation,
                wanted: view.size,
                samples: scene.render.samples,
                last,
                milliseconds: 1e3 * begin.elapsed().as_secs_f64(),
                rate: rays / drawn.max(1e-9),
                error: film.tally.quantile(0.5).unwrap_or(f64::NAN),
                given_up: film.tally.given_up,
            };
            frame::encode(&picture, &label)
        });
        // What is made but once does not count.
        self.pace.learn(kind, rays, ready.elapsed().as_secs_f64());
        self.send.blocking_send(Sent::Frame(bytes)).map_err(|_| End::Gone)
    }
}

/// What a scene's speed depends on, roughly.
fn kind(scene: &Scene) -> String {
    let name = &scene.file().spacetime.name;
    let layers = !scene.render.layers.is_empty() || scene.display.layer.is_some();
    let shines = scene.disk.as_ref().is_some_and(kerrscope::scene::Disk::needs_rays);
    format!("{name:?}, {:?}, {} things, {layers}, {shines}", scene.render.engine, scene.objects.len())
}

/// Pixels below which every ray is traced.
const FEW: u32 = 24_000;

/// What a coarse picture may be off by where it is interpolated: less than its pixels.
const COARSE: f64 = 0.003;

/// The same scene with fewer pixels and one ray in each, through the centre, so that nothing flickers in motion.
fn coarser(scene: &Scene, divisor: f64) -> Scene {
    let mut scene = scene.clone();
    let [width, height] = divided([scene.render.width, scene.render.height], divisor);
    scene.render.width = width;
    scene.render.height = height;
    scene.render.samples = 1;
    scene.render.jitter = false;
    // Few rays are traced sooner than it is found out which could be interpolated.
    let many = width * height > FEW;
    scene.render.adaptive = scene.render.adaptive.filter(|_| many).map(|error| error.max(COARSE));
    scene
}
