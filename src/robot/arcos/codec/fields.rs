//! Fields in the order in which a packet holds them, read as far as the packet goes.

/// Reads little-endian fields. Once one is cut off, nothing follows: what is left would be read askew.
#[derive(Clone, Copy, Debug)]
pub struct Reader<'a>(pub &'a [u8]);

impl Reader<'_> {
    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let Some((head, rest)) = self.0.split_first_chunk::<N>() else {
            self.0 = &[];
            return None;
        };
        self.0 = rest;
        Some(*head)
    }

    pub fn u8(&mut self) -> Option<u8> {
        self.take().map(u8::from_le_bytes)
    }

    pub fn i8(&mut self) -> Option<i8> {
        self.take().map(i8::from_le_bytes)
    }

    pub fn u16(&mut self) -> Option<u16> {
        self.take().map(u16::from_le_bytes)
    }

    pub fn i16(&mut self) -> Option<i16> {
        self.take().map(i16::from_le_bytes)
    }

    pub fn u32(&mut self) -> Option<u32> {
        self.take().map(u32::from_le_bytes)
    }

    pub fn i32(&mut self) -> Option<i32> {
        self.take().map(i32::from_le_bytes)
    }

    /// Up to and without the NUL; a text without one is cut off.
    pub fn text(&mut self) -> Option<Text> {
        let Some(end) = self.0.iter().position(|byte| *byte == 0) else {
            self.0 = &[];
            return None;
        };
        let text = String::from_utf8_lossy(&self.0[..end]).into_owned();
        self.0 = &self.0[end + 1..];
        Some(text)
    }
}

/// A text field.
pub type Text = String;

/// A field that can be written as it is read.
pub trait Field {
    /// Appends the field to a packet's data.
    fn write(&self, data: &mut Vec<u8>);
}

macro_rules! number_fields {
    ($($kind:ty),*) => { $(impl Field for $kind {
        fn write(&self, data: &mut Vec<u8>) {
            data.extend(self.to_le_bytes());
        }
    })* };
}
number_fields!(u8, i8, u16, i16, u32, i32);

impl Field for Text {
    fn write(&self, data: &mut Vec<u8>) {
        data.extend(self.bytes().filter(|byte| *byte != 0));
        data.push(0);
    }
}

/// A struct of optional fields in the order of the wire. `Text` is read by `text`, numbers by their own name.
macro_rules! optional_fields {
    ($(#[$about:meta])* pub struct $name:ident { $($(#[$doc:meta])* $field:ident: $kind:ident by $read:ident,)* }) => {
        $(#[$about])*
        #[derive(Clone, Debug, Default, PartialEq)]
        pub struct $name { $($(#[$doc])* pub $field: Option<$kind>,)* }

        impl $name {
            /// Reads the fields that are there.
            fn read(reader: &mut $crate::robot::arcos::codec::fields::Reader) -> Self {
                Self { $($field: reader.$read(),)* }
            }

            /// Writes the fields up to the first that is missing.
            fn write(&self, data: &mut Vec<u8>) {
                use $crate::robot::arcos::codec::fields::Field;
                $(match &self.$field {
                    Some(value) => value.write(data),
                    None => return,
                })*
            }
        }
    };
}
pub(super) use optional_fields;
