//! Header of a NumPy file.

/// Marks of a file in format 1.0.
const MAGIC: &[u8] = b"\x93NUMPY\x01\x00";
/// The data begins at a multiple of this.
const ALIGNED: usize = 64;

/// Header of a structured array whose number of rows is known only at the end.
#[derive(Debug)]
pub(super) struct Header {
    fields: String,
    /// Length in bytes, enough for any number of rows.
    length: usize,
}

impl Header {
    /// Creates a header with `tick`, `time_s` and these columns.
    pub(super) fn new(columns: Vec<String>) -> Self {
        let columns = ["time_s".to_owned()].into_iter().chain(columns);
        let fields = columns.map(|name| format!(", ('{name}', '<f8')"));
        let fields = format!("('tick', '<u8'){}", fields.collect::<String>());
        let longest = MAGIC.len() + 2 + dictionary(&fields, u64::MAX).len() + 1;
        Header {
            fields,
            length: longest.next_multiple_of(ALIGNED),
        }
    }

    /// Returns the header of a file with this number of rows; its length is always the same.
    pub(super) fn bytes(&self, rows: u64) -> Vec<u8> {
        let length = self.length - MAGIC.len() - 2;
        let text = dictionary(&self.fields, rows);
        let mut bytes = MAGIC.to_vec();
        bytes.extend((length as u16).to_le_bytes());
        bytes.extend(format!("{text:<width$}\n", width = length - 1).bytes());
        bytes
    }
}

fn dictionary(fields: &str, rows: u64) -> String {
    format!("{{'descr': [{fields}], 'fortran_order': False, 'shape': ({rows},), }}")
}
