//! What a SPIR-V module says of itself.

/// Opcodes and words as SPIR-V's specification numbers them.
const HEADER: usize = 5;
const OP_EXTENSION: u32 = 10;
const OP_ENTRY_POINT: u32 = 15;
const OP_CAPABILITY: u32 = 17;

#[derive(Debug, Default)]
pub struct Declared {
    pub entry_points: usize,
    pub capabilities: Vec<u32>,
    pub extensions: Vec<String>,
}

/// What the module of these bytes declares.
pub fn declared(spirv: &[u8]) -> Declared {
    let words: Vec<u32> =
        spirv.chunks_exact(4).map(|word| u32::from_le_bytes(word.try_into().unwrap())).collect();
    let mut declared = Declared::default();
    let mut rest = &words[HEADER..];
    while let Some(&first) = rest.first() {
        let (length, code) = ((first >> 16) as usize, first & 0xffff);
        let (instruction, following) = rest.split_at(length);
        match code {
            OP_ENTRY_POINT => declared.entry_points += 1,
            OP_CAPABILITY => declared.capabilities.push(instruction[1]),
            OP_EXTENSION => {
                let bytes: Vec<u8> = instruction[1..].iter().flat_map(|word| word.to_le_bytes()).collect();
                let text = bytes.split(|&byte| byte == 0).next().unwrap();
                declared.extensions.push(String::from_utf8(text.to_vec()).unwrap());
            }
            _ => {}
        }
        rest = following;
    }
    declared
}
