//! Maps as NumPy arrays.
use npyz::{AutoSerialize, WriterBuilder};
use std::io::{self, Write};

/// Writes `values` as an array of this `shape`, last index fastest, in the machine-independent form of its type
/// (`f32` as `<f4`, `u8` as `|u1`).
///
/// # Errors
/// Those of `into`, and one when there are not exactly as many values as `shape` has places.
pub fn write<T: AutoSerialize>(
    into: &mut (impl Write + ?Sized),
    shape: &[u64],
    values: impl IntoIterator<Item = T>,
) -> io::Result<()> {
    let mut writer = npyz::WriteOptions::new().default_dtype().shape(shape).writer(into).begin_nd()?;
    writer.extend(values)?;
    writer.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_are_those_of_the_format() {
        let mut bytes = Vec::new();
        write(&mut bytes, &[2, 1, 3], [1.0f32, 2.0, 3.0, -1.0, 0.5, 0.0]).unwrap();
        assert_eq!(&bytes[..8], b"\x93NUMPY\x01\0");
        let header_end = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
        assert_eq!(header_end % 64, 0);
        let header = str::from_utf8(&bytes[10..header_end]).unwrap();
        assert!(header.contains("'descr': '<f4'") && header.contains("'fortran_order': False"), "{header}");
        assert!(header.contains("'shape': (2, 1, 3"), "{header}");
        assert_eq!(&bytes[header_end..header_end + 8], [0, 0, 0x80, 0x3f, 0, 0, 0, 0x40]);
        assert_eq!(bytes.len(), header_end + 24);
    }

    #[test]
    fn a_wrong_number_of_values_is_refused() {
        assert!(write(&mut Vec::new(), &[2, 2], [1u8, 2, 3]).is_err());
        assert!(write(&mut Vec::new(), &[1], [1u8, 2, 3]).is_err());
    }
}
