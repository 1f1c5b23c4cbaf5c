//! What files hold: meshes, drawings and height fields. From bytes to plain geometry; opening files is for others.

pub mod drawing;
pub mod height;
pub mod mesh;
