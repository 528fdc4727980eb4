//! A trial.
#![allow(missing_docs, clippy::all)]
use fsi_coupling::entry_theory::*;
fn main() {
    let a: Vec<f64> = std::env::args().skip(1).map(|x| x.parse().unwrap()).collect();
    let (d0, deep) = (a[0], a[1]);
    let pts: Vec<[f64; 2]> = a[2..].chunks(2).map(|c| [c[0], c[1]]).collect();
    // (x, angle) pairs
    let mut cs = vec![[0.0, 0.0]];
    for [x, t] in pts {
        let [px, py] = cs[cs.len() - 1];
        cs.push([x, py + (x - px) * t.to_radians().tan()]);
    }
    let s = Section::new(&cs).unwrap();
    let t = std::time::Instant::now();
    let mut f = EntryFlow::new(&s, d0, 1.0, 0.0).unwrap();
    let mut n = 0;
    let mut next = d0;
    let dump: Vec<f64> = std::env::var("DUMP").unwrap_or_default().split(',').filter_map(|x| x.parse().ok()).collect();
    let mut di = 0;
    while f.draught() < deep {
        let (d, w, cw) = (f.draught(), f.half_width(), f.chines_wet());
        match f.step(|_| 0.0) {
            Ok((dt, l)) => {
                if di < dump.len() && d >= dump[di] {
                    di += 1;
                    for p in &l.pressure {
                        println!("   x {:.4} p {:.3}", p[0], p[1]);
                    }
                }
                if d >= next {
                    next *= std::env::var("NX").ok().and_then(|x| x.parse().ok()).unwrap_or(1.03);
                    let lo = l.pressure.iter().map(|p| p[1]).fold(0.0, f64::min);
                    let hi = l.pressure.iter().map(|p| p[1]).fold(0.0, f64::max);
                    println!(
                        "{n} h {d:.5} w {w:.4} {cw} F {:.4} F/h {:.3} M {:.4} dt {dt:.2e} p {lo:.2} {hi:.2} n {} xs {:.4}",
                        l.force,
                        l.force / d,
                        l.added_mass,
                        l.pressure.len() + f.surface().len(),
                        l.pressure[0][0]
                    );
                }
            }
            Err(e) => {
                println!("{n} {e}");
                break;
            }
        }
        n += 1;
    }
    println!("steps {n} {:.2} s h {}", t.elapsed().as_secs_f64(), f.draught());
}
