//! Files in ZIP archives, and XML in them.

use super::MeshError;
use std::io::{Cursor, Read};

/// No file in an archive may unpack to more bytes than these.
const LARGEST: u64 = 1 << 30;

/// A ZIP archive in memory.
pub(super) struct Archive<'a>(zip::ZipArchive<Cursor<&'a [u8]>>);

/// Whether the bytes begin as ZIP archives do.
pub(super) fn is_archive(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04")
}

impl<'a> Archive<'a> {
    pub fn open(bytes: &'a [u8]) -> Result<Self, MeshError> {
        zip::ZipArchive::new(Cursor::new(bytes)).map(Self).map_err(|e| MeshError::Archive(e.to_string()))
    }

    /// The names of all files, as they come; those that are not text are passed over.
    pub fn names(&self) -> Vec<String> {
        self.0.file_names().flatten().map(String::from).collect()
    }

    /// The content of a file, as text. Names begin with a slash or not, in capitals or not.
    pub fn text(&mut self, name: &str) -> Result<Option<String>, MeshError> {
        let wanted = name.trim_start_matches('/');
        let same = |other: &String| other.trim_start_matches('/').eq_ignore_ascii_case(wanted);
        let Some(name) = self.names().into_iter().find(same) else { return Ok(None) };
        let problem = |e: &dyn std::fmt::Display| MeshError::Archive(format!("{name}: {e}"));
        let file = self.0.by_name(&name).map_err(|e| problem(&e))?;
        let mut bytes = Vec::new();
        file.take(LARGEST + 1).read_to_end(&mut bytes).map_err(|e| problem(&e))?;
        if bytes.len() as u64 > LARGEST {
            return Err(problem(&"unpacks to more than a gigabyte"));
        }
        String::from_utf8(bytes).map(Some).map_err(|e| problem(&e))
    }
}

/// An XML file and its name, for errors.
pub(super) struct Xml<'a> {
    part: &'a str,
    pub document: roxmltree::Document<'a>,
}

impl<'a> Xml<'a> {
    pub fn parse(part: &'a str, text: &'a str) -> Result<Self, MeshError> {
        match roxmltree::Document::parse(text) {
            Ok(document) => Ok(Self { part, document }),
            Err(cause) => Err(MeshError::Xml { part: part.to_string(), cause }),
        }
    }

    /// An error about an element.
    pub fn error(&self, node: roxmltree::Node, problem: impl Into<String>) -> MeshError {
        let line = self.document.text_pos_at(node.range().start).row;
        MeshError::Element { part: self.part.to_string(), line, problem: problem.into() }
    }

    /// A number in an element: `word` is the element's text or an attribute, which `what` names.
    pub fn number(&self, node: roxmltree::Node, what: &str, word: Option<&str>) -> Result<f64, MeshError> {
        match word.map(str::trim).map(str::parse::<f64>) {
            Some(Ok(number)) if number.is_finite() => Ok(number),
            _ => Err(self.error(node, format!("{what} is no finite number"))),
        }
    }

    /// As [`Self::number`], an index of one of `known` points.
    pub fn index(&self, node: roxmltree::Node, what: &str, word: Option<&str>, known: usize) -> Result<u32, MeshError> {
        match word.map(str::trim).map(str::parse::<u32>) {
            Some(Ok(index)) if (index as usize) < known => Ok(index),
            _ => Err(self.error(node, format!("{what} names none of the {known} vertices"))),
        }
    }
}

/// The children of an element with that name, whatever its namespace.
pub(super) fn children<'a, 'i>(
    node: roxmltree::Node<'a, 'i>,
    name: &'static str,
) -> impl Iterator<Item = roxmltree::Node<'a, 'i>> {
    node.children().filter(move |child| child.is_element() && child.tag_name().name() == name)
}
