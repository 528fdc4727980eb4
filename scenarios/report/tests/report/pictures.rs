use super::HOSTILE;
use report::{FlowFrame, FlowView, flow_png, flow_svg, viridis};

/// A decoded picture.
struct Image {
    width: usize,
    height: usize,
    pixels: Vec<[u8; 3]>,
}

impl Image {
    fn of(frame: &FlowFrame, view: &FlowView) -> Self {
        let file = flow_png(frame, view);
        let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().expect("a PNG header");
        let mut bytes = vec![0; reader.output_buffer_size().expect("a size that fits")];
        let info = reader.next_frame(&mut bytes).expect("a PNG image");
        assert_eq!((info.color_type, info.bit_depth), (png::ColorType::Rgba, png::BitDepth::Eight));
        // on white paper
        let mix = |p: &[u8], k: usize| (u32::from(p[k]) * u32::from(p[3]) + 255 * (255 - u32::from(p[3]))) / 255;
        let on_paper = |p: &[u8]| [0, 1, 2].map(|k| mix(p, k) as u8);
        let pixels = bytes[..info.buffer_size()].chunks_exact(4).map(on_paper).collect();
        Self { width: info.width as usize, height: info.height as usize, pixels }
    }

    /// Colour at a position [m] in the window of `view`.
    fn at(&self, view: &FlowView, x: f64, y: f64) -> [u8; 3] {
        let scale = self.width as f64 / (view.x[1] - view.x[0]);
        let (column, row) = ((x - view.x[0]) * scale, (view.y[1] - y) * scale);
        self.pixels[row as usize * self.width + column as usize]
    }
}

pub fn view() -> FlowView {
    FlowView {
        x: [-0.5, 0.5],
        y: [-0.3, 0.1],
        value: [0.0, 20.0],
        width_px: 800,
        label: "pressure [kPa]".into(),
        mirror_x: false,
    }
}

/// About 20 000 particles below y = 0, 3 mm apart at the surface and coarser with depth, under
/// hydrostatic pressure.
fn graded_lattice() -> FlowFrame {
    let mut frame = FlowFrame::default();
    let mut y = -0.0015;
    while y > -0.6 {
        let size = 0.003 - 0.01 * y;
        let columns = (1.2 / size) as i32;
        for column in 0..columns {
            frame.x.push((-0.6 + size * (f64::from(column) + 0.5)) as f32);
            frame.y.push(y as f32);
            frame.value.push((-9.81 * y) as f32);
            frame.size.push(size as f32);
        }
        y -= size;
    }
    frame
}

pub fn particles(list: &[(f32, f32, f32)]) -> FlowFrame {
    FlowFrame {
        x: list.iter().map(|p| p.0).collect(),
        y: list.iter().map(|p| p.1).collect(),
        value: list.iter().map(|p| p.2).collect(),
        size: vec![0.02; list.len()],
        ..Default::default()
    }
}

#[test]
fn a_particle_has_the_colour_of_its_value_where_it_is() {
    let (frame, view) = (particles(&[(0.2, -0.1, 5.0), (-0.3, 0.05, 20.0), (0.0, -0.2, 1e9)]), view());
    let image = Image::of(&frame, &view);
    assert_eq!(image.width, 800);
    assert_eq!(image.height, 320);
    assert_eq!(image.at(&view, 0.2, -0.1), viridis(0.25));
    assert_eq!(image.at(&view, -0.3, 0.05), viridis(1.0));
    assert_eq!(image.at(&view, 0.0, -0.2), viridis(1.0));
    assert_eq!(image.at(&view, 0.2, -0.05), [255; 3]);
}

#[test]
fn the_colour_map_is_viridis() {
    // From the published table of 256 colours: entries 0, 64, 128, 192 and 255.
    let published = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];
    for (entry, rgb) in [0, 64, 128, 192, 255].into_iter().zip(published) {
        let ours = viridis(f64::from(entry) / 255.0);
        let error = (0..3).map(|k| i32::abs_diff(ours[k].into(), rgb[k])).max();
        assert!(error <= Some(1), "entry {entry}: {ours:?} against {rgb:?}");
    }
    assert_eq!(viridis(-3.0), viridis(0.0));
    assert_eq!(viridis(f64::INFINITY), viridis(1.0));
    assert_eq!(viridis(f64::NAN), viridis(0.0));
}

#[test]
fn a_value_that_is_not_a_number_shows() {
    let view = view();
    let colour = Image::of(&particles(&[(0.0, 0.0, f32::NAN)]), &view).at(&view, 0.0, 0.0);
    let distance = |t: i32| {
        let map = viridis(f64::from(t) / 100.0);
        (0..3).map(|k| map[k].abs_diff(colour[k])).max()
    };
    assert!((0..=100).all(|t| distance(t) > Some(60)), "{colour:?} looks like a value");
    assert_ne!(colour, [255; 3]);
}

#[test]
fn a_graded_lattice_is_covered_without_holes_whatever_its_order() {
    let (mut frame, view) = (graded_lattice(), view());
    assert!((15_000..30_000).contains(&frame.x.len()), "{} particles", frame.x.len());
    let image = Image::of(&frame, &view);
    let surface = image.width / 10 + 2;
    for (i, pixel) in image.pixels[surface * image.width..320 * image.width].iter().enumerate() {
        assert_ne!(*pixel, [255; 3], "hole at column {}, row {}", i % image.width, surface + i / image.width);
    }
    let deep = image.at(&view, 0.1, -0.25);
    let exact = viridis(9.81 * 0.25 / 20.0);
    assert!((0..3).all(|k| deep[k].abs_diff(exact[k]) <= 3), "{deep:?} against {exact:?}");
    for array in [&mut frame.x, &mut frame.y, &mut frame.value, &mut frame.size] {
        array.reverse();
    }
    assert!(Image::of(&frame, &view).pixels == image.pixels);
}

#[test]
fn the_mirror_image_has_no_seam() {
    let view = FlowView { mirror_x: true, ..view() };
    let mut frame = particles(&[(0.3, -0.2, 10.0), (-0.1, -0.2, 20.0)]);
    frame.outlines = vec![vec![[0.0, -0.1], [0.2, 0.0], [0.2, 0.05], [0.0, 0.05]]];
    frame.walls = vec![[0.4, -0.25]];
    frame.wall_size = 0.02;
    let image = Image::of(&frame, &view);
    for (x, y) in [(0.3, -0.2), (0.1, 0.02), (0.4, -0.25)] {
        let (right, left) = (image.at(&view, x, y), image.at(&view, -x, y));
        assert_ne!(right, [255; 3], "nothing at ({x}, {y})");
        assert!((0..3).all(|k| right[k].abs_diff(left[k]) <= 1), "({x}, {y}): {right:?} and {left:?}");
    }
    assert_eq!(image.at(&view, -0.1, -0.2), [255; 3], "the half that is not computed is not drawn twice");
    let body = image.at(&view, 0.1, 0.02);
    assert_eq!(image.at(&view, 0.0, 0.0), body);
    for x in [0.1, -0.1] {
        let darkest = (-3..=3).map(|i| image.at(&view, x, -0.05 + 0.001 * f64::from(i))[0]).min();
        assert!(darkest < Some(80), "outline at x = {x}: {darkest:?}");
    }
}

#[test]
fn any_frame_and_view_give_a_picture() {
    let mut frame = particles(&[(f32::NAN, 0.0, 1.0), (0.0, f32::INFINITY, 1.0), (0.0, 0.0, 1.0), (1e30, -1e30, 1.0)]);
    frame.size = vec![f32::NAN, 1.0, 0.0];
    frame.time = f64::NAN;
    frame.outlines = vec![vec![], vec![[0.0, 0.0]], vec![[f64::NAN, 0.0], [1e300, 1.0], [0.1, -1e300], [0.0, 0.1]]];
    frame.walls = vec![[f64::NAN, 0.0], [1e200, 0.0], [0.0, 0.0]];
    for range in [[0.0, 0.0], [f64::NAN, 1.0], [1.0, -1.0], [-1e308, 1e308], [1e9, 1e9 + 1e-6]] {
        for width_px in [0, 333] {
            let view = FlowView { x: range, value: range, width_px, label: HOSTILE.into(), ..view() };
            assert_eq!(Image::of(&frame, &view).width, width_px.max(200) as usize);
            let view = FlowView { y: range, mirror_x: true, ..view };
            assert!(Image::of(&frame, &view).height < 1000);
            super::xml::assert_well_formed(&flow_svg(&frame, &view));
        }
    }
}

/// The legend names time, value and length, with ticks at round values.
#[test]
fn the_legend_is_text() {
    let svg = flow_svg(&FlowFrame { time: 0.25, ..particles(&[(0.0, 0.0, 5.0)]) }, &view());
    for text in ["t = 0.2500 s", "pressure [kPa]", "0.2 m", ">0<", ">20<"] {
        assert!(svg.contains(text), "{text} is missing");
    }
    super::xml::assert_well_formed(&svg);
}
