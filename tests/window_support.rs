//! What the tests of windows stand on, met by a client that is as small as can be: a window of one colour.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may panic")]
mod support;

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Duration;
use support::limit::Limit;
use support::xvfb::{ESCAPE, Xvfb};
use x11rb::connection::Connection as _;
use x11rb::protocol::Event;
use x11rb::protocol::xproto::{
    AtomEnum, ConnectionExt as _, CreateWindowAux, EventMask, Gravity, PropMode, WindowClass,
};
use x11rb::rust_connection::RustConnection;
use x11rb::wrapper::ConnectionExt as _;

const SIZE: [u32; 2] = [100, 60];
const COLOUR: u32 = 0x20_60_c0;
const RGB: [u8; 3] = [0x20, 0x60, 0xc0];

/// A client with a window "a small window" at (30, 20).
fn client(screen: &Xvfb) -> (RustConnection, u32) {
    let (connection, number) = x11rb::connect(Some(screen.display())).unwrap();
    let root = connection.setup().roots[number].root;
    let id = connection.generate_id().unwrap();
    let looks = CreateWindowAux::new()
        .background_pixel(COLOUR)
        .bit_gravity(Gravity::NORTH_WEST)
        .event_mask(EventMask::STRUCTURE_NOTIFY | EventMask::KEY_PRESS | EventMask::BUTTON_PRESS);
    let [width, height] = SIZE.map(|side| u16::try_from(side).unwrap());
    connection
        .create_window(24, id, root, 30, 20, width, height, 0, WindowClass::INPUT_OUTPUT, 0, &looks)
        .unwrap();
    let title = b"a small window";
    connection.change_property8(PropMode::REPLACE, id, AtomEnum::WM_NAME, AtomEnum::STRING, title).unwrap();
    let [protocols, delete] = [b"WM_PROTOCOLS".as_slice(), b"WM_DELETE_WINDOW"]
        .map(|name| connection.intern_atom(false, name).unwrap().reply().unwrap().atom);
    connection.change_property32(PropMode::REPLACE, id, protocols, AtomEnum::ATOM, &[delete]).unwrap();
    connection.map_window(id).unwrap();
    connection.sync().unwrap();
    (connection, id)
}

/// The next event that `take` takes.
fn wait<T>(connection: &RustConnection, take: impl Fn(&Event) -> Option<T>) -> T {
    loop {
        if let Some(taken) = take(&connection.wait_for_event().unwrap()) {
            return taken;
        }
    }
}

#[test]
fn the_screen_shows_the_window_where_it_is() {
    let screen = Xvfb::start([320, 200]);
    let (_connection, _) = client(&screen);
    let window = screen.window("small");
    assert_eq!(window.frame(), ([30, 20], SIZE));
    let shot = screen.screenshot_when(|shot| shot.pixel(30, 20) == RGB);
    assert_eq!(shot.size, [320, 200]);
    for (x, y, colour) in
        [(29, 20, [0; 3]), (30, 19, [0; 3]), (129, 79, RGB), (130, 79, [0; 3]), (129, 80, [0; 3])]
    {
        assert_eq!(shot.pixel(x, y), colour, "{x}, {y}");
    }
    let picture = window.picture();
    assert!(picture.size == SIZE && picture.colours() == 1 && picture.pixel(0, 0) == RGB);
}

#[test]
fn the_window_hears_what_is_done_to_it() {
    let screen = Xvfb::start([320, 200]);
    let (connection, id) = client(&screen);
    let window = screen.window("a small window");

    window.resize([140, 90]);
    let size = wait(&connection, |event| match event {
        Event::ConfigureNotify(event) => Some([event.width, event.height]),
        _ => None,
    });
    assert_eq!((size, window.frame().1), ([140, 90], [140, 90]));
    screen.screenshot_when(|shot| shot.pixel(169, 109) == RGB);

    window.minimise();
    wait(&connection, |event| matches!(event, Event::UnmapNotify(_)).then_some(()));
    assert!(window.is_there() && !window.is_shown());
    screen.screenshot_when(|shot| shot.colours() == 1);
    window.restore();
    wait(&connection, |event| matches!(event, Event::MapNotify(_)).then_some(()));
    assert!(window.is_shown());

    window.focus();
    screen.key(ESCAPE, true);
    screen.key(ESCAPE, false);
    let code = wait(&connection, |event| match event {
        Event::KeyPress(event) => Some(event.detail),
        _ => None,
    });
    assert_eq!(connection.get_keyboard_mapping(code, 1).unwrap().reply().unwrap().keysyms[0], ESCAPE);

    screen.point(40, 50);
    screen.button(1, true);
    screen.button(1, false);
    let place = wait(&connection, |event| match event {
        Event::ButtonPress(event) => Some([event.event_x, event.event_y]),
        _ => None,
    });
    assert_eq!(place, [10, 30]);

    window.close();
    wait(&connection, |event| matches!(event, Event::ClientMessage(_)).then_some(()));
    connection.destroy_window(id).unwrap();
    connection.sync().unwrap();
    assert!(!window.is_there());
    assert_eq!(screen.titles(), [""; 0]);
}

#[test]
fn servers_run_side_by_side() {
    let [one, other] = [(); 2].map(|()| Xvfb::start([64, 48]));
    assert_ne!(one.display(), other.display());
    let (_connection, _) = client(&one);
    one.window("small");
    assert_eq!(other.titles(), [""; 0]);
}

#[test]
fn a_server_that_never_answers_is_given_up() {
    let screen = Xvfb::start([200, 100]);
    let limit = Limit::new(screen.id(), Duration::from_secs(2));
    limit.now("a picture of a server that stands still");
    kill(Pid::from_raw(screen.id().try_into().unwrap()), Signal::SIGSTOP).unwrap();
    let waited = catch_unwind(AssertUnwindSafe(|| screen.screenshot()));
    assert!(waited.is_err(), "it has answered");
}
