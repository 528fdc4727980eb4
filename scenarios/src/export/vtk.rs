//! Frames for ParaView: PolyData in the XML format of VTK, with raw binary data appended ("VTK File Formats", Kitware).

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use run::log::{LoggedFrame, Point};

use super::frame_writer::FrameWriter;

/// Groups of files, each with a collection of its own.
const GROUPS: [&str; 3] = ["fluid", "walls", "bodies"];

pub(super) struct VtkWriter {
    folder: PathBuf,
    times: Vec<f64>,
}

impl VtkWriter {
    pub fn new(folder: &Path) -> VtkWriter {
        VtkWriter { folder: folder.to_owned(), times: Vec::new() }
    }
}

impl FrameWriter for VtkWriter {
    fn frame(&mut self, number: usize, frame: &LoggedFrame) -> io::Result<()> {
        self.times.push(frame.time);
        let loops: Vec<Vec<[f64; 2]>> = frame.bodies.iter().flat_map(|body| body.loops.clone()).collect();
        let pieces = [particles(frame.fluid().collect()), particles(frame.walls().collect()), outlines(&loops)];
        for (group, piece) in GROUPS.iter().zip(pieces) {
            piece.write(&self.folder.join(file_name(group, number)))?;
        }
        Ok(())
    }

    fn finish(self: Box<Self>) -> io::Result<()> {
        for group in GROUPS {
            let sets = self.times.iter().enumerate().map(|(number, time)| {
                format!("    <DataSet timestep=\"{time:e}\" part=\"0\" file=\"{}\"/>\n", file_name(group, number))
            });
            let text = format!(
                "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n  <Collection>\n{}  \
                 </Collection>\n</VTKFile>\n",
                sets.collect::<String>()
            );
            std::fs::write(self.folder.join(format!("{group}.pvd")), text)?;
        }
        Ok(())
    }
}

fn file_name(group: &str, number: usize) -> String {
    format!("{group}_{number:04}.vtp")
}

/// A piece of PolyData: arrays in XML, their values appended.
struct Piece {
    points: usize,
    verts: usize,
    polys: usize,
    /// Place (points, point data, vertices, polygons), type, name, components, values.
    arrays: Vec<(Place, &'static str, &'static str, usize, Vec<u8>)>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Place {
    Points,
    PointData,
    Verts,
    Polys,
}

fn floats(values: impl Iterator<Item = f64>) -> Vec<u8> {
    values.flat_map(|value| (value as f32).to_le_bytes()).collect()
}

fn integers(values: impl Iterator<Item = usize>) -> Vec<u8> {
    values.flat_map(|value| (value as i64).to_le_bytes()).collect()
}

/// Each particle is a vertex.
fn particles(points: Vec<Point>) -> Piece {
    let count = points.len();
    let scalar = |of: fn(&Point) -> f64| floats(points.iter().map(of));
    let vector = |of: fn(&Point) -> [f64; 2]| {
        floats(points.iter().flat_map(|point| {
            let [x, y] = of(point);
            [x, y, 0.0]
        }))
    };
    let arrays = vec![
        (Place::PointData, "Float32", "pressure_Pa", 1, scalar(|p| p.pressure)),
        (Place::PointData, "Float32", "velocity_m_per_s", 3, vector(|p| p.velocity)),
        (Place::PointData, "Float32", "density_kg_per_m3", 1, scalar(|p| p.density)),
        (Place::PointData, "Float32", "spacing_m", 1, scalar(|p| p.spacing)),
        (Place::PointData, "Int64", "id", 1, integers(points.iter().map(|p| p.id as usize))),
        (Place::Points, "Float32", "position_m", 3, vector(|p| p.at)),
        (Place::Verts, "Int64", "connectivity", 1, integers(0..count)),
        (Place::Verts, "Int64", "offsets", 1, integers(1..=count)),
    ];
    Piece { points: count, verts: count, polys: 0, arrays }
}

/// Each loop is a polygon.
fn outlines(loops: &[Vec<[f64; 2]>]) -> Piece {
    let corners: Vec<[f64; 2]> = loops.iter().flatten().copied().collect();
    let ends = loops.iter().scan(0, |end, corners| {
        *end += corners.len();
        Some(*end)
    });
    let arrays = vec![
        (Place::Points, "Float32", "position_m", 3, floats(corners.iter().flat_map(|[x, y]| [*x, *y, 0.0]))),
        (Place::Polys, "Int64", "connectivity", 1, integers(0..corners.len())),
        (Place::Polys, "Int64", "offsets", 1, integers(ends)),
    ];
    Piece { points: corners.len(), verts: 0, polys: loops.len(), arrays }
}

impl Piece {
    fn write(&self, path: &Path) -> io::Result<()> {
        let mut file = BufWriter::new(File::create(path)?);
        writeln!(file, "<?xml version=\"1.0\"?>")?;
        writeln!(
            file,
            "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n<Piece \
             NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"{}\">",
            self.points, self.verts, self.polys
        )?;
        let mut offset = 0;
        let offsets: Vec<usize> = self
            .arrays
            .iter()
            .map(|(.., bytes)| {
                let here = offset;
                offset += size_of::<u64>() + bytes.len();
                here
            })
            .collect();
        for (place, name) in [
            (Place::PointData, "PointData"),
            (Place::Points, "Points"),
            (Place::Verts, "Verts"),
            (Place::Polys, "Polys"),
        ] {
            writeln!(file, "<{name}>")?;
            for ((_, kind, array, components, _), offset) in
                self.arrays.iter().zip(&offsets).filter(|((own, ..), _)| *own == place)
            {
                writeln!(
                    file,
                    "<DataArray type=\"{kind}\" Name=\"{array}\" NumberOfComponents=\"{components}\" format=\"appended\" \
                     offset=\"{offset}\"/>"
                )?;
            }
            writeln!(file, "</{name}>")?;
        }
        write!(file, "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_")?;
        for (.., bytes) in &self.arrays {
            file.write_all(&(bytes.len() as u64).to_le_bytes())?;
            file.write_all(bytes)?;
        }
        write!(file, "\n</AppendedData>\n</VTKFile>\n")?;
        file.flush()
    }
}
