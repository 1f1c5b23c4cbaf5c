//! Programs as flat arrays of words.
//!
//! A program is a CSG tree in negation normal form: `And` and `Or` over signed literals, nothing else. Differences have
//! become intersections with complements, complements were pushed down to the literals, nested equal operators are one.
//! It is held in prefix order in an array of 32-bit words, two bits of tag and thirty of payload: a literal's index, or
//! the number of words below an operator.

/// One word of a program, decoded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Word {
    /// Inside where the literal's surface is (`negated`: where it is not).
    Literal {
        /// Index into [`Catalog::literals`](super::Catalog::literals).
        index: u32,
        /// Whether the outside is meant.
        negated: bool,
    },
    /// Inside where all the children are, which take the next `len` words.
    And {
        /// How many words the children take.
        len: u32,
    },
    /// Inside where any of the children is.
    Or {
        /// How many words the children take.
        len: u32,
    },
}

const PAYLOAD: u32 = (1 << 30) - 1;
const TAG: u32 = 0b11 << 30;
const NEGATED: u32 = 0b01 << 30;
const AND: u32 = 0b10 << 30;
const OR: u32 = 0b11 << 30;

impl Word {
    /// The largest literal index and operator length.
    pub const MAX_PAYLOAD: u32 = PAYLOAD;

    /// Decodes a word.
    #[inline]
    pub fn decode(word: u32) -> Self {
        let payload = word & PAYLOAD;
        match word & TAG {
            AND => Self::And { len: payload },
            OR => Self::Or { len: payload },
            sign => Self::Literal { index: payload, negated: sign == NEGATED },
        }
    }

    /// A word whose literal's number is greater by `by`.
    #[inline]
    pub(crate) fn shifted(word: u32, by: u32) -> u32 {
        match Self::decode(word) {
            Self::Literal { .. } => word + by,
            Self::And { .. } | Self::Or { .. } => word,
        }
    }

    /// Encodes a word.
    #[inline]
    pub fn encode(self) -> u32 {
        match self {
            Self::Literal { index, negated } => index | if negated { NEGATED } else { 0 },
            Self::And { len } => AND | len,
            Self::Or { len } => OR | len,
        }
    }
}

/// The index just behind the node that starts at `at`.
#[inline]
pub fn node_end(words: &[u32], at: usize) -> usize {
    match Word::decode(words[at]) {
        Word::Literal { .. } => at + 1,
        Word::And { len } | Word::Or { len } => at + 1 + len as usize,
    }
}

/// How many operators lie above the deepest literal.
pub fn nesting(words: &[u32]) -> usize {
    let (mut deepest, mut open) = (0, Vec::new());
    for (at, &word) in words.iter().enumerate() {
        while open.last().is_some_and(|&end| end <= at) {
            open.pop();
        }
        if let Word::And { len } | Word::Or { len } = Word::decode(word) {
            open.push(at + 1 + len as usize);
            deepest = deepest.max(open.len());
        }
    }
    deepest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_survive_encoding() {
        for word in [
            Word::Literal { index: 0, negated: false },
            Word::Literal { index: Word::MAX_PAYLOAD, negated: true },
            Word::And { len: 7 },
            Word::Or { len: Word::MAX_PAYLOAD },
        ] {
            assert_eq!(Word::decode(word.encode()), word);
        }
    }
}
