use super::HOSTILE;
use report::{Chart, Curve, Mark, TrendLine, chart_svg};

use super::xml::assert_well_formed;

pub fn curve(mark: Mark, x: Vec<f64>, y: Vec<f64>) -> Curve {
    Curve { label: format!("{mark:?}"), mark, x, y, ..Curve::default() }
}

pub fn chart(curves: Vec<Curve>) -> Chart {
    Chart {
        title: "Force".into(),
        x_label: "time [s]".into(),
        y_label: "force [N/m]".into(),
        curves,
        ..Chart::default()
    }
}

/// Equal factors are equal distances, and what has no logarithm is left out.
#[test]
fn logarithmic_axes() {
    let points =
        |x: Vec<f64>, y: Vec<f64>| chart_svg(&Chart { logarithmic: true, ..chart(vec![curve(Mark::Points, x, y)]) });
    let clean = points(vec![1.0, 10.0, 100.0], vec![5.0, 0.5, 0.05]);
    assert_well_formed(&clean);
    assert_eq!(clean, points(vec![1.0, -1.0, 10.0, 0.0, 100.0], vec![5.0, 1.0, 0.5, 1.0, 0.05]));
    let markers = clean.split("<circle r=\"3.4\" transform=\"translate(").skip(1);
    let centres: Vec<f64> = markers.filter_map(|c| c.split(' ').next()?.parse().ok()).collect();
    assert!(centres.len() >= 3, "{clean}");
    let (first, second) = (centres[1] - centres[0], centres[2] - centres[1]);
    assert!(first > 10.0 && (first - second).abs() < 0.1, "{centres:?}");
}

#[test]
fn charts_are_well_formed_whatever_the_data() {
    let nan = f64::NAN;
    let data: [(Vec<f64>, Vec<f64>); 9] = [
        (vec![], vec![]),
        (vec![nan; 3], vec![1.0; 3]),
        (vec![0.0, 1.0, 2.0], vec![nan, f64::INFINITY, 1.0]),
        (vec![1.0], vec![1.0]),
        (vec![1.0; 5], vec![-2.0; 5]),
        (vec![0.0, 1.0], vec![-f64::MAX, f64::MAX]),
        (vec![0.0, 5e-324], vec![0.0, 1e-310]),
        (vec![0.0, 1.0, 2.0, 3.0], vec![1.0]),
        ((0..5000).map(f64::from).collect(), (0..5000).map(|i| f64::from(i % 7)).collect()),
    ];
    let ranges = [None, Some([0.0, 1.0]), Some([2.0, 2.0]), Some([nan, 1.0]), Some([3.0, -3.0])];
    for (x, y) in &data {
        for (range, mark) in ranges.iter().zip([Mark::Line, Mark::Dashed, Mark::Points].into_iter().cycle()) {
            for (x_range, y_range) in [(*range, None), (None, *range), (*range, *range)] {
                let mut chart = chart(vec![curve(mark, x.clone(), y.clone())]);
                chart.curves[0].label = HOSTILE.into();
                (chart.title, chart.x_label, chart.y_label) = (HOSTILE.into(), HOSTILE.into(), HOSTILE.into());
                (chart.x_range, chart.y_range) = (x_range, y_range);
                let svg = chart_svg(&chart);
                assert_well_formed(&svg);
                for bad in ["NaN", "inf", "<script"] {
                    assert!(!svg.contains(bad), "{bad} in a chart of {x:?}, {y:?} over {x_range:?}, {y_range:?}");
                }
                assert!(svg.contains("$x^2$"), "labels are printed literally");
            }
        }
    }
    let nothing = chart_svg(&chart(vec![]));
    assert_well_formed(&nothing);
    assert!(nothing.contains("no data"));
}

#[test]
fn a_long_curve_is_thinned_and_keeps_its_peak() {
    let count = 200_000;
    let x: Vec<f64> = (0..count).map(|i| f64::from(i) / f64::from(count - 1)).collect();
    let mut y: Vec<f64> = x.iter().map(|x| 0.2 * (300.0 * x).sin()).collect();
    y[123_456] = 1.9;
    let alone = vec![curve(Mark::Line, vec![0.0, x[123_456], 1.0], vec![0.0, 1.9, 0.0])];
    let ranged = |curves| chart_svg(&Chart { x_range: Some([0.0, 1.0]), y_range: Some([-1.0, 2.0]), ..chart(curves) });
    let (long, short) = (ranged(vec![curve(Mark::Line, x, y)]), ranged(alone));
    let points = |svg: &str| -> Vec<String> {
        let (_, data) = svg.split_once("class=\"data\"").expect("the data");
        let (_, path) = data.split_once("<path d=\"M ").expect("a path");
        let path = path.split('"').next().unwrap_or_default();
        path.split("L ").map(|point| point.trim().to_owned()).collect()
    };
    let apex = &points(&short)[1];
    assert!(points(&long).contains(apex), "the peak at {apex} is gone");
    assert!((500..=1000).contains(&points(&long).len()), "{} points", points(&long).len());
}

#[test]
fn a_zoomed_chart_draws_the_window_in_full() {
    let x: Vec<f64> = (0..100_000).map(|i| f64::from(i) * 1e-5).collect();
    let y: Vec<f64> = x.iter().map(|x| x.sin()).collect();
    let window = Chart { x_range: Some([0.5, 0.502]), ..chart(vec![curve(Mark::Points, x, y)]) };
    let drawn = chart_svg(&window).matches("<circle").count();
    // 201 points in the window and one marker in the legend.
    assert_eq!(drawn, 202);
}

#[test]
fn curves_differ_in_colour_and_the_same_chart_in_nothing() {
    let line = |k: i32| curve(Mark::Line, vec![0.0, 1.0], vec![0.0, f64::from(k)]);
    let seven = chart((0..7).map(line).collect());
    let svg = chart_svg(&seven);
    let (_, data) = svg.split_once("class=\"data\"").expect("the data");
    let (data, _) = data.split_once("</g>").expect("its end");
    let mut colours: Vec<_> =
        data.split("<path").skip(1).map(|p| p.split_once("stroke=\"").map(|s| &s.1[..7])).collect();
    colours.sort_unstable();
    colours.dedup();
    assert_eq!(colours.len(), 7);
    chart_svg(&chart(vec![line(1)]));
    assert_eq!(chart_svg(&seven), svg);
}

#[test]
fn hollow_marks_are_outlines_and_trends_have_their_curves_colour() {
    let dots = |mark| chart(vec![curve(mark, vec![1.0, 10.0, 100.0], vec![9.0, 3.0, 1.0])]);
    let [full, hollow] = [Mark::Points, Mark::Hollow].map(|mark| chart_svg(&Chart { logarithmic: true, ..dots(mark) }));
    // three points and the legend
    assert_eq!([&full, &hollow].map(|svg| svg.matches("fill-opacity=\"0\"").count()), [0, 4]);
    let trends = vec![TrendLine { curve: 0, ends: [[1.0, 9.0], [100.0, 1.0]] }];
    let with = chart_svg(&Chart { logarithmic: true, trends, ..dots(Mark::Points) });
    let lines = |svg: &str| svg.matches("stroke=\"#0072b2\"").count();
    assert_eq!(lines(&with), lines(&full) + 1);
    assert_well_formed(&with);
}
