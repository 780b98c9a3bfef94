//! Numbers and blocks as bytes: little-endian 64-bit numbers after a magic word.

pub(crate) struct Writer {
    bytes: Vec<u8>,
}

impl Writer {
    pub(crate) fn new(magic: &[u8; 8]) -> Self {
        Self {
            bytes: magic.to_vec(),
        }
    }

    pub(crate) fn number(&mut self, value: usize) {
        self.bytes.extend((value as u64).to_le_bytes());
    }

    pub(crate) fn block(&mut self, block: &[u8]) {
        self.number(block.len());
        self.bytes.extend(block);
    }

    pub(crate) fn finish(self) -> Vec<u8> {
        self.bytes
    }
}

pub(crate) struct Reader<'a> {
    rest: &'a [u8],
}

impl<'a> Reader<'a> {
    pub(crate) fn new(bytes: &'a [u8], magic: &[u8; 8]) -> Result<Self, String> {
        match bytes.strip_prefix(magic) {
            Some(rest) => Ok(Self { rest }),
            None => Err(format!(
                "the bytes do not start with {}",
                String::from_utf8_lossy(magic)
            )),
        }
    }

    pub(crate) fn number(&mut self) -> Result<usize, String> {
        let Some((first, rest)) = self.rest.split_first_chunk::<8>() else {
            return Err("the bytes end too early".to_owned());
        };
        self.rest = rest;
        usize::try_from(u64::from_le_bytes(*first))
            .map_err(|_| "a number does not fit this machine".to_owned())
    }

    /// A number of things that take at least eight bytes each.
    pub(crate) fn count(&mut self) -> Result<usize, String> {
        let count = self.number()?;
        if count > self.rest.len() / 8 {
            return Err(format!(
                "{count} entries are announced, but the bytes end before"
            ));
        }
        Ok(count)
    }

    /// The last block: nothing may follow it.
    pub(crate) fn block(&mut self) -> Result<&'a [u8], String> {
        let length = self.number()?;
        if length != self.rest.len() {
            return Err(format!(
                "a block of {length} bytes is announced, but {} are left",
                self.rest.len()
            ));
        }
        Ok(self.rest)
    }
}
