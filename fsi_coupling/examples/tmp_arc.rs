//! t
use fsi_coupling::entry_theory::*;
fn main() {
    let a: Vec<f64> = std::env::args().skip(1).map(|x| x.parse().unwrap()).collect();
    let (start, end) = (a[0], a[1]);
    let clock = std::time::Instant::now();
    let section = Section::arc(1.0, 2.0).unwrap();
    let mut flow = EntryFlow::new(&section, start, 1.0, a[2]).unwrap();
    let mlm = Loads::new(EntryModel::Mlm, &section).unwrap();
    let mut next = -1.0;
    let mut k = 0;
    loop {
        let h = flow.draught();
        let w = flow.half_width();
        let n = flow.surface().len();
        let wet = flow.chines_wet();
        match flow.step(|_| 0.0) {
            Ok((dt, load)) => {
                if h >= next || std::env::var("V").is_ok() {
                    let hi = load.pressure.iter().map(|p| 2.0 * p[1]).fold(0.0, f64::max);
                    let lo = load.pressure.iter().map(|p| 2.0 * p[1]).fold(0.0, f64::min);
                    let plus: f64 = load
                        .pressure
                        .windows(2)
                        .map(|p| (p[0][1].max(0.0) + p[1][1].max(0.0)) * (p[0][0] - p[1][0]))
                        .sum();
                    let at = load.pressure.iter().skip_while(|p| p[1] <= 0.02).next().map_or(0.0, |p| p[0]);
                    println!(
                        "plus {plus:.3} from x {at:.4} {k} h {h:.4} Cs {:.3} mlm {:.3} M {:.4} c {w:.4} cpmax {hi:.3} cpmin {lo:.4} n {n}+{} dt {dt:.2e} wet {wet} t {:.2}",
                        load.force,
                        mlm.at(h).slam,
                        load.added_mass,
                        load.pressure.len(),
                        clock.elapsed().as_secs_f64()
                    );
                    next = h.max(0.002) * 1.15;
                }
            }
            Err(e) => {
                println!("{e}");
                break;
            }
        }
        k += 1;
        if h > end || k > 4000 {
            break;
        }
    }
}
