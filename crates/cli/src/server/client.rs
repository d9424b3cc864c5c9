//! One client: passes its messages to its painter, and what the painter makes to the client.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use axum::body::Bytes;
use axum::extract::ws::{Message, WebSocket};
use tokio::sync::mpsc;
use tokio::task::JoinHandle;
use tokio::time::timeout;

use super::House;
use super::asked::{Asked, View};
use super::desk::Desk;
use super::facts::Notice;
use super::painter::Painter;
use super::saver;
use super::stock::Refusal;
use crate::trace;

/// How long a client may take for a message before it counts as gone.
const PATIENCE: Duration = Duration::from_secs(20);

/// What goes to a client.
#[derive(Debug)]
pub enum Sent {
    /// JSON.
    Text(String),
    /// A frame.
    Frame(Vec<u8>),
}

/// Serves a client until it leaves.
pub async fn serve(mut socket: WebSocket, house: Arc<House>) {
    // One is on its way while the next is drawn; a painter that is ahead waits.
    let (send, mut made) = mpsc::channel(1);
    let desk = Arc::new(Desk::default());
    let save_send = send.clone();
    let stop_saving = Arc::new(AtomicBool::new(false));
    let mut saving: Option<JoinHandle<()>> = None;
    let painter = Painter::new(Arc::clone(&house), Arc::clone(&desk), send);
    if thread::Builder::new().name("painter".to_owned()).spawn(move || painter.run()).is_err() {
        let words = Notice::Fault("there are no more threads: close other pages".to_owned()).json();
        let _ = timeout(PATIENCE, socket.send(Message::Text(words.into()))).await;
        return;
    }
    loop {
        let answer = tokio::select! {
            made = made.recv() => match made {
                Some(Sent::Text(text)) => Some(Message::Text(text.into())),
                Some(Sent::Frame(bytes)) => Some(Message::Binary(Bytes::from(bytes))),
                None => break,
            },
            message = socket.recv() => match message {
                Some(Ok(Message::Text(text))) => match Asked::read(&text) {
                    Ok(Asked::Show(view)) => {
                        desk.put(view);
                        None
                    }
                    Ok(Asked::Inspect { view, at }) => {
                        Some(Message::Text(inspect(Arc::clone(&house), view, at).await.json().into()))
                    }
                    Ok(Asked::Save { view, format }) => {
                        if saving.as_ref().is_some_and(|task| !task.is_finished()) {
                            let words = "a picture is being saved: wait until it is done, or stop it".to_owned();
                            let notice = Notice::unsaved(view.generation, &Refusal::Wish(words));
                            Some(Message::Text(notice.json().into()))
                        } else {
                            stop_saving.store(false, Ordering::Relaxed);
                            let (house, stop) = (Arc::clone(&house), Arc::clone(&stop_saving));
                            let send = save_send.clone();
                            let work = move || saver::save(&house, &view, format, &stop, &send);
                            saving = Some(tokio::task::spawn_blocking(work));
                            None
                        }
                    }
                    Ok(Asked::Stop) => {
                        stop_saving.store(true, Ordering::Relaxed);
                        None
                    }
                    Err(fault) => Some(Message::Text(Notice::Fault(fault).json().into())),
                },
                Some(Ok(Message::Binary(_))) => {
                    let fault = "messages are JSON as text".to_owned();
                    Some(Message::Text(Notice::Fault(fault).json().into()))
                }
                Some(Ok(Message::Ping(_) | Message::Pong(_))) => None,
                Some(Ok(Message::Close(_)) | Err(_)) | None => break,
            },
        };
        if let Some(answer) = answer
            && !matches!(timeout(PATIENCE, socket.send(answer)).await, Ok(Ok(())))
        {
            break;
        }
    }
    desk.close();
    stop_saving.store(true, Ordering::Relaxed);
}

/// Points of a ray's way that are told.
const POINTS: usize = 400;

/// The ray at a place of a picture.
async fn inspect(house: Arc<House>, view: View, at: [f64; 2]) -> Notice {
    let generation = view.generation;
    let work = move || -> Result<Notice, Refusal> {
        let scene = house.stock.scene(&view, view.samples)?;
        let point = [0, 1].map(|k| at[k] * f64::from(view.size[k]));
        let (ray, horizon) = trace::at_point(&scene, point, POINTS).map_err(Refusal::Wish)?;
        Ok(Notice::Ray { generation, at, horizon, ray })
    };
    match tokio::task::spawn_blocking(work).await {
        Ok(Ok(notice)) => notice,
        Ok(Err(refusal)) => Notice::refusal(generation, &refusal),
        Err(_) => {
            Notice::Fault("a fault of kerrscope itself, please report it with the page's address".to_owned())
        }
    }
}
