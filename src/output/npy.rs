//! Maps as NumPy arrays, format version 1.0.
use std::io::{self, Write};

/// A number that arrays are made of.
pub trait Element: Copy {
    /// Its type in the header's words.
    const TYPE: &str;

    /// Writes it in that type's own form, which is the same on every machine.
    ///
    /// # Errors
    /// Those of `into`.
    fn write(self, into: &mut (impl Write + ?Sized)) -> io::Result<()>;
}

impl Element for f32 {
    const TYPE: &str = "<f4";

    fn write(self, into: &mut (impl Write + ?Sized)) -> io::Result<()> {
        into.write_all(&self.to_le_bytes())
    }
}

impl Element for u8 {
    const TYPE: &str = "|u1";

    fn write(self, into: &mut (impl Write + ?Sized)) -> io::Result<()> {
        into.write_all(&[self])
    }
}

/// Bytes before the header's text: the magic word, the version, the text's length.
const PREFIX: usize = 10;
/// Values begin at a multiple of this.
const ALIGN: usize = 64;

/// Writes `values` as an array of this `shape` (of two dimensions or more), last index fastest.
///
/// # Errors
/// Those of `into`, and one when there are not exactly as many values as `shape` has places.
pub fn write<T: Element>(
    into: &mut (impl Write + ?Sized),
    shape: &[u64],
    values: impl IntoIterator<Item = T>,
) -> io::Result<()> {
    let wrong = |problem: String| io::Error::new(io::ErrorKind::InvalidInput, problem);
    let sides = shape.iter().map(u64::to_string).collect::<Vec<_>>().join(", ");
    let text = format!("{{'descr': '{}', 'fortran_order': False, 'shape': ({sides}), }}", T::TYPE);
    // Spaces and a line's end fill it up.
    let length = (PREFIX + text.len() + 1).next_multiple_of(ALIGN) - PREFIX;
    let field =
        u16::try_from(length).map_err(|_| wrong(format!("{} dimensions are too many", shape.len())))?;
    into.write_all(b"\x93NUMPY\x01\0")?;
    into.write_all(&field.to_le_bytes())?;
    writeln!(into, "{text:width$}", width = length - 1)?;
    let (wanted, mut given) = (shape.iter().product::<u64>(), 0);
    for value in values {
        value.write(into)?;
        given += 1;
    }
    if given == wanted {
        Ok(())
    } else {
        Err(wrong(format!("{given} values given for an array of {wanted}")))
    }
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
    fn others_read_it() {
        let mut bytes = Vec::new();
        write(&mut bytes, &[2, 3], 0_u8..6).unwrap();
        let file = npyz::NpyFile::new(&bytes[..]).unwrap();
        assert_eq!((file.shape(), file.order()), (&[2, 3][..], npyz::Order::C));
        assert_eq!(file.into_vec::<u8>().unwrap(), [0, 1, 2, 3, 4, 5]);
    }

    #[test]
    fn a_wrong_number_of_values_is_refused() {
        assert!(write(&mut Vec::new(), &[2, 2], [1u8, 2, 3]).is_err());
        assert!(write(&mut Vec::new(), &[1], [1u8, 2, 3]).is_err());
    }
}
