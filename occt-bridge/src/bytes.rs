//! Numbers and blocks as bytes: little-endian 64-bit numbers after a magic word, and a checksum at the end, because the kernel's reader
//! must not see what it did not write.

pub(crate) struct Writer {
    bytes: Vec<u8>,
}

impl Writer {
    pub(crate) fn new(magic: [u8; 8]) -> Self {
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

    pub(crate) fn finish(mut self) -> Vec<u8> {
        self.bytes.extend(checksum(&self.bytes).to_le_bytes());
        self.bytes
    }
}

/// FNV-1a, 64 bits.
fn checksum(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

pub(crate) struct Reader<'a> {
    rest: &'a [u8],
}

impl<'a> Reader<'a> {
    pub(crate) fn new(bytes: &'a [u8], magic: [u8; 8]) -> Result<Self, String> {
        let Some((content, sum)) = bytes.split_last_chunk::<8>() else {
            return Err("the bytes end too early".to_owned());
        };
        let Some(rest) = content.strip_prefix(&magic) else {
            return Err(format!(
                "the bytes do not start with {}",
                String::from_utf8_lossy(&magic)
            ));
        };
        if checksum(content) != u64::from_le_bytes(*sum) {
            return Err("the bytes were changed or cut off: their checksum is wrong".to_owned());
        }
        Ok(Self { rest })
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
