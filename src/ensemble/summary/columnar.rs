//! The table of realisations as Parquet: numbers as they are, by column, for programs that read a few columns of many rows.
//!
//! One row group, plain pages, no compression: what it saves is reading text, and columns that nobody asks for.

use std::sync::Arc;

use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::{Type, TypePtr};

use super::tables::{Kind, Values, columns};
use super::whole::Summary;
use crate::export::ExportError;

/// The same table as `realisations.csv`.
pub fn parquet(summary: &Summary) -> Result<Vec<u8>, ExportError> {
    written(&columns(summary)).map_err(|error| ExportError::Table(error.to_string()))
}

fn written(columns: &[Values<'_>]) -> Result<Vec<u8>, ParquetError> {
    let fields = columns.iter().map(field).collect::<Result<_, _>>()?;
    let schema = Type::group_type_builder("realisations").with_fields(fields);
    let properties = WriterProperties::builder()
        .set_created_by(concat!("clinothem ", env!("CARGO_PKG_VERSION")).to_owned())
        .build();
    let (schema, properties) = (Arc::new(schema.build()?), Arc::new(properties));
    let mut bytes = Vec::new();
    let mut file = SerializedFileWriter::new(&mut bytes, schema, properties)?;
    let mut group = file.next_row_group()?;
    for column in columns {
        let Some(mut writer) = group.next_column()? else {
            break;
        };
        // Of what may lack a value: 1 where there is one.
        let levels = |is_there: &mut dyn Iterator<Item = bool>| -> Vec<i16> {
            is_there.map(i16::from).collect()
        };
        match &column.of {
            Kind::Text(values) => {
                let there = levels(&mut values.iter().map(Option::is_some));
                let texts: Vec<ByteArray> =
                    values.iter().copied().flatten().map(Into::into).collect();
                let typed = writer.typed::<ByteArrayType>();
                typed.write_batch(&texts, Some(&there), None)?;
            }
            Kind::Whole(values) => {
                // Parquet has no other whole numbers: these bits are read as they were, without a sign.
                let bits: Vec<i64> = values.iter().map(|value| value.cast_signed()).collect();
                writer.typed::<Int64Type>().write_batch(&bits, None, None)?;
            }
            Kind::Number(values) => {
                let there = levels(&mut values.iter().map(Option::is_some));
                let numbers: Vec<f64> = values.iter().copied().flatten().collect();
                let typed = writer.typed::<DoubleType>();
                typed.write_batch(&numbers, Some(&there), None)?;
            }
        }
        writer.close()?;
    }
    group.close()?;
    file.close()?;
    Ok(bytes)
}

fn field(column: &Values<'_>) -> Result<TypePtr, ParquetError> {
    let (physical, repetition, logical) = match column.of {
        Kind::Text(_) => (
            Physical::BYTE_ARRAY,
            Repetition::OPTIONAL,
            Some(LogicalType::String),
        ),
        Kind::Whole(_) => (
            Physical::INT64,
            Repetition::REQUIRED,
            Some(LogicalType::integer(64, false)),
        ),
        Kind::Number(_) => (Physical::DOUBLE, Repetition::OPTIONAL, None),
    };
    let field = Type::primitive_type_builder(&column.name, physical)
        .with_repetition(repetition)
        .with_logical_type(logical);
    Ok(Arc::new(field.build()?))
}
