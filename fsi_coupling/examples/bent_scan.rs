//! A trial.
#![allow(missing_docs, clippy::all)]
use fsi_coupling::entry_theory::*;
fn main() {
    let a: Vec<f64> = std::env::args().skip(1).map(|x| x.parse().unwrap()).collect();
    let (seed, count) = (a[0] as u64, a[1] as usize);
    let mut s = seed.wrapping_mul(0x9E3779B97F4A7C15) | 1;
    let mut r = move || {
        s ^= s << 13;
        s ^= s >> 7;
        s ^= s << 17;
        (s >> 11) as f64 / (1u64 << 53) as f64
    };
    for k in 0..count {
        let faces = 2 + (r() * 2.0) as usize;
        let mut xs: Vec<f64> = (1..faces).map(|_| 0.15 + 0.7 * r()).collect();
        xs.sort_by(|a, b| a.total_cmp(b));
        xs.push(1.0);
        let ang: Vec<f64> = (0..faces).map(|j| if j == 0 { 13.0 + 27.0 * r() } else { 15.0 + 45.0 * r() }).collect();
        let mut cs = vec![[0.0, 0.0]];
        for (x, t) in xs.iter().zip(&ang) {
            let [px, py] = cs[cs.len() - 1];
            cs.push([*x, py + (x - px) * t.to_radians().tan()]);
        }
        let section = Section::new(&cs).unwrap();
        let free = r() > 0.5;
        let motion = if free { SectionMotion::Free(1000.0 + 3000.0 * r()) } else { SectionMotion::Constant };
        let speed = 2.0 + 6.0 * r();
        let h = cs[cs.len() - 1][1].min(1.0);
        let end = if free { 2.0 * h / speed } else { h / speed };
        let times: Vec<f64> = (0..=400).map(|k| end * k as f64 / 400.0).collect();
        let t = std::time::Instant::now();
        let e = FlowEntry { section: &section, motion, draught: 0.0, speed, gravity: 9.81, density: 1000.0 };
        let txt = format!("{k} x {xs:.3?} a {ang:.1?} V {speed:.2} free {free}");
        match e.solve(&times) {
            Ok((i, _, end)) => {
                let top = i.iter().map(|n| n.force).fold(0.0, f64::max);
                let jump = i
                    .windows(2)
                    .map(|w| (w[1].force - w[0].force).abs() / top)
                    .enumerate()
                    .fold((0, 0.0), |m, x| if x.1 > m.1 { x } else { m });
                println!(
                    "{txt} {:.2}s reached {:.3} of {h:.3} w {:.2} jump {:.3} at h {:.3} {}",
                    t.elapsed().as_secs_f64(),
                    i.last().unwrap().draught,
                    i.last().unwrap().wetted,
                    jump.1,
                    i[jump.0].draught,
                    end.map_or("".into(), |e| e.what)
                );
            }
            Err(e) => println!("{txt} ERR {e}"),
        }
    }
}
