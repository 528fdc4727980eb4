//! A table of named columns, as CSV (RFC 4180) and as Apache Parquet.

use std::fs::File;
use std::path::Path;
use std::sync::Arc;

use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical, ZstdLevel};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, FloatType, Int64Type};
use parquet::errors::Result;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use parquet::schema::types::Type;

/// The cells of a column; `None` is an empty one.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Cells {
    /// Texts.
    Text(Vec<Option<String>>),
    /// Numbers of double precision.
    Double(Vec<Option<f64>>),
    /// Numbers of single precision, none missing.
    Single(Vec<f32>),
    /// Whole numbers.
    Whole(Vec<Option<i64>>),
}

impl Cells {
    fn len(&self) -> usize {
        match self {
            Cells::Text(cells) => cells.len(),
            Cells::Double(cells) => cells.len(),
            Cells::Single(cells) => cells.len(),
            Cells::Whole(cells) => cells.len(),
        }
    }

    fn text(&self, row: usize) -> String {
        fn known<T: ToString>(cell: Option<&T>) -> String {
            cell.map_or_else(String::new, T::to_string)
        }
        match self {
            Cells::Text(cells) => known(cells[row].as_ref()),
            Cells::Double(cells) => known(cells[row].as_ref()),
            Cells::Single(cells) => cells[row].to_string(),
            Cells::Whole(cells) => known(cells[row].as_ref()),
        }
    }
}

/// Columns of equal length.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct DataTable {
    columns: Vec<(String, Cells)>,
}

impl DataTable {
    /// Add a column; its name must be new, its length that of the others.
    pub fn push(&mut self, name: impl Into<String>, cells: Cells) {
        self.columns.push((name.into(), cells));
    }

    /// Add a column of texts.
    pub fn texts(&mut self, name: impl Into<String>, cells: impl Iterator<Item = Option<String>>) {
        self.push(name, Cells::Text(cells.collect()));
    }

    /// Add a column of numbers.
    pub fn numbers(&mut self, name: impl Into<String>, cells: impl Iterator<Item = Option<f64>>) {
        self.push(name, Cells::Double(cells.collect()));
    }

    /// Add a column of whole numbers.
    pub fn wholes(&mut self, name: impl Into<String>, cells: impl Iterator<Item = Option<usize>>) {
        self.push(name, Cells::Whole(cells.map(|cell| cell.map(|value| value as i64)).collect()));
    }

    /// As CSV with a heading.
    pub fn to_csv(&self) -> String {
        let rows = self.columns.first().map_or(0, |(_, cells)| cells.len());
        let head = csv_row(self.columns.iter().map(|(name, _)| name.clone()));
        let row = |row: usize| csv_row(self.columns.iter().map(|(_, cells)| cells.text(row)));
        head + &(0..rows).map(row).collect::<String>()
    }

    /// As a Parquet file.
    pub fn write_parquet(&self, path: &Path) -> std::io::Result<()> {
        let mut file = ParquetFile::create(path)?;
        file.append(self)?;
        file.finish()
    }
}

/// A row of CSV (RFC 4180).
fn csv_row(cells: impl Iterator<Item = String>) -> String {
    let quoted = |cell: String| match cell.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", cell.replace('"', "\"\"")),
        false => cell,
    };
    cells.map(quoted).collect::<Vec<_>>().join(",") + "\n"
}

/// A Parquet file that takes one table after the other, all of the same columns, each as a row group.
pub(crate) struct ParquetFile {
    file: Option<File>,
    writer: Option<SerializedFileWriter<File>>,
}

impl ParquetFile {
    /// An empty file.
    pub fn create(path: &Path) -> std::io::Result<ParquetFile> {
        Ok(ParquetFile { file: Some(File::create(path)?), writer: None })
    }

    /// Append the rows of a table; the first one sets the columns.
    pub fn append(&mut self, table: &DataTable) -> std::io::Result<()> {
        if let Some(file) = self.file.take() {
            self.writer = Some(started(file, table)?);
        }
        match &mut self.writer {
            Some(writer) => Ok(row_group(writer, table)?),
            None => Ok(()),
        }
    }

    /// Write the footer.
    pub fn finish(mut self) -> std::io::Result<()> {
        match self.writer.take() {
            Some(writer) => Ok(writer.close().map(|_| ())?),
            None => Ok(()),
        }
    }
}

fn started(file: File, table: &DataTable) -> Result<SerializedFileWriter<File>> {
    let field = |(name, cells): &(String, Cells)| {
        let (physical, logical) = match cells {
            Cells::Text(_) => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
            Cells::Double(_) => (Physical::DOUBLE, None),
            Cells::Single(_) => (Physical::FLOAT, None),
            Cells::Whole(_) => (Physical::INT64, None),
        };
        let field = Type::primitive_type_builder(name, physical);
        field.with_repetition(Repetition::OPTIONAL).with_logical_type(logical).build().map(Arc::new)
    };
    let fields = table.columns.iter().map(field).collect::<Result<Vec<_>>>()?;
    let schema = Type::group_type_builder("table").with_fields(fields).build()?;
    let properties = WriterProperties::builder().set_compression(Compression::ZSTD(ZstdLevel::default())).build();
    SerializedFileWriter::new(file, Arc::new(schema), Arc::new(properties))
}

fn row_group(writer: &mut SerializedFileWriter<File>, table: &DataTable) -> Result<()> {
    let mut group = writer.next_row_group()?;
    for (_, cells) in &table.columns {
        let Some(mut column) = group.next_column()? else { break };
        match cells {
            Cells::Text(cells) => {
                let bytes = cells.iter().map(|cell| cell.as_deref().map(ByteArray::from));
                write_column::<ByteArrayType>(&mut column, bytes)?;
            }
            Cells::Double(cells) => write_column::<DoubleType>(&mut column, cells.iter().copied())?,
            Cells::Single(cells) => write_column::<FloatType>(&mut column, cells.iter().copied().map(Some))?,
            Cells::Whole(cells) => write_column::<Int64Type>(&mut column, cells.iter().copied())?,
        }
        column.close()?;
    }
    group.close().map(|_| ())
}

/// Definition level 1 stands for a value, 0 for an empty cell.
fn write_column<T: DataType>(
    column: &mut SerializedColumnWriter<'_>,
    cells: impl Iterator<Item = Option<T::T>> + Clone,
) -> Result<()> {
    let levels: Vec<i16> = cells.clone().map(|cell| i16::from(cell.is_some())).collect();
    let values: Vec<T::T> = cells.flatten().collect();
    column.typed::<T>().write_batch(&values, Some(&levels), None).map(|_| ())
}

#[cfg(test)]
mod tests {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::RowAccessor;

    use super::*;

    fn table() -> DataTable {
        let mut table = DataTable::default();
        table.wholes("point", [Some(1), Some(2)].into_iter());
        table.numbers("force", [Some(1.5), None].into_iter());
        table.texts("message", [None, Some("a, \"b\"".to_string())].into_iter());
        table.push("x", Cells::Single(vec![0.25, -1.0]));
        table
    }

    #[test]
    fn csv_quotes_and_leaves_empty() {
        assert_eq!(table().to_csv(), "point,force,message,x\n1,1.5,,0.25\n2,,\"a, \"\"b\"\"\",-1\n");
    }

    #[test]
    fn parquet_comes_back() {
        let folder = temp_dir::TempDir::new().expect("a folder");
        let path = folder.path().join("t.parquet");
        let mut file = ParquetFile::create(&path).expect("a file");
        for _ in 0..2 {
            file.append(&table()).expect("rows");
        }
        file.finish().expect("a footer");
        let reader = SerializedFileReader::new(File::open(&path).expect("the file")).expect("Parquet");
        assert_eq!(reader.num_row_groups(), 2);
        let rows: Vec<_> = reader.get_row_iter(None).expect("rows").map(|row| row.expect("a row")).collect();
        assert_eq!(rows.len(), 4);
        assert_eq!(rows[2].get_long(0).ok().zip(rows[2].get_double(1).ok()), Some((1, 1.5)));
        assert!(rows[3].get_double(1).is_err() && rows[2].get_string(2).is_err());
        assert_eq!(rows[3].get_string(2).expect("a text"), "a, \"b\"");
        assert_eq!(rows[3].get_float(3).ok(), Some(-1.0));
    }
}
