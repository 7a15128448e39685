//! Head, hands and buttons of a `Service` with `Devices::Remote`, sent over TCP as its driver wants them.
use super::monado::Service;
use std::io::Write as _;
use std::net::{Ipv4Addr, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// A place and a turn: metres, and a quaternion x, y, z, w.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    pub position: [f32; 3],
    pub orientation: [f32; 4],
}

impl Pose {
    pub fn at(x: f32, y: f32, z: f32) -> Self {
        Self { position: [x, y, z], orientation: [0.0, 0.0, 0.0, 1.0] }
    }

    /// Turned about +Y, radians, positive to the left.
    pub fn turned(mut self, yaw: f32) -> Self {
        let (sine, cosine) = (yaw / 2.0).sin_cos();
        self.orientation = [0.0, sine, 0.0, cosine];
        self
    }
}

/// A controller; all zero is one that lies at the origin untouched.
#[derive(Clone, Copy, Debug)]
pub struct Hand {
    pub pose: Pose,
    /// 0 to 1.
    pub trigger: f32,
    /// 0 to 1.
    pub squeeze: f32,
    /// -1 to 1, right and up.
    pub thumbstick: [f32; 2],
    pub thumbstick_click: bool,
    /// A, or X on the left.
    pub a: bool,
    /// B, or Y on the left.
    pub b: bool,
    /// Menu on the left, system on the right.
    pub menu: bool,
    /// Whether there is one.
    pub active: bool,
}

impl Hand {
    pub fn at(pose: Pose) -> Self {
        Self {
            pose,
            trigger: 0.0,
            squeeze: 0.0,
            thumbstick: [0.0; 2],
            thumbstick_click: false,
            a: false,
            b: false,
            menu: false,
            active: true,
        }
    }
}

#[derive(Clone, Copy, Debug)]
pub struct Body {
    /// Its origin is the floor's, so eyes are at a height of about 1.6 m.
    pub head: Pose,
    /// Left, right.
    pub hands: [Hand; 2],
}

impl Body {
    /// Standing at the origin, looking along -Z, hands in front.
    pub fn standing() -> Self {
        let hand = |x| Hand::at(Pose::at(x, 1.3, -0.5));
        Self { head: Pose::at(0.0, 1.6, 0.0), hands: [hand(-0.2), hand(0.2)] }
    }

    /// The driver's packet (Monado 25: `r_interface.h`, "mndrmt3").
    fn packet(&self) -> Vec<u8> {
        let mut packet = Packet(b"mndrmt3\0".to_vec());
        for _view in 0..2 {
            packet.floats(&[0.0; 4]); // field of view, of no effect without the flag below
            packet.pose(Pose::at(0.0, 0.0, 0.0));
            packet.0.extend([0; 4]); // whether it counts
        }
        packet.pose(self.head);
        packet.0.extend([0; 4]); // no data for each view
        for hand in &self.hands {
            packet.pose(hand.pose);
            packet.floats(&[0.0; 6]); // velocities
            packet.floats(&[0.0; 5]); // fingers
            packet.floats(&[hand.trigger, hand.squeeze, 0.0, hand.thumbstick[0], hand.thumbstick[1]]);
            packet.floats(&[0.0; 3]); // trackpad
            packet.flags(&[false, hand.active, hand.menu, hand.menu, hand.a, hand.a, hand.b, hand.b]);
            let stick = hand.thumbstick_click || hand.thumbstick != [0.0; 2];
            packet.flags(&[hand.trigger > 0.5, hand.trigger > 0.0, hand.thumbstick_click, stick]);
            packet.flags(&[false; 4]);
        }
        assert_eq!(packet.0.len(), 376);
        packet.0
    }
}

struct Packet(Vec<u8>);

impl Packet {
    fn floats(&mut self, values: &[f32]) {
        self.0.extend(values.iter().flat_map(|value| value.to_le_bytes()));
    }
    fn flags(&mut self, values: &[bool]) {
        self.0.extend(values.iter().map(|&value| u8::from(value)));
    }
    fn pose(&mut self, pose: Pose) {
        self.floats(&pose.orientation);
        self.floats(&pose.position);
    }
}

/// Sends a hundred times a second, until it is dropped or the service is gone.
pub struct Remote {
    stop: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Remote {
    /// `body` says how things are so many seconds after the first packet.
    pub fn start(service: &Service, body: impl Fn(f32) -> Body + Send + 'static) -> Self {
        let started = Instant::now();
        let mut connection = loop {
            match TcpStream::connect((Ipv4Addr::LOCALHOST, service.port())) {
                Ok(connection) => break connection,
                Err(error) => assert!(
                    started.elapsed() < Duration::from_secs(30),
                    "the remote driver does not listen: {error}; Monado's log:\n{}",
                    service.log()
                ),
            }
            std::thread::sleep(Duration::from_millis(50));
        };
        connection.set_nodelay(true).unwrap();
        let stop = Arc::new(AtomicBool::new(false));
        let told = Arc::clone(&stop);
        let thread = std::thread::spawn(move || {
            let started = Instant::now();
            while !told.load(Ordering::Relaxed) {
                if connection.write_all(&body(started.elapsed().as_secs_f32()).packet()).is_err() {
                    return; // the service was stopped, as tests do
                }
                std::thread::sleep(Duration::from_millis(10));
            }
        });
        Self { stop, thread: Some(thread) }
    }
}

impl Drop for Remote {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}
