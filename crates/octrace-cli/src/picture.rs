//! From film to PNG: 8 or 16 bits, with an alpha channel only where it is asked for.

use octrace::film::Film;
use std::io;

/// Bits per sample in the picture file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BitDepth {
    /// 0 to 255.
    Eight,
    /// 0 to 65535.
    Sixteen,
}

/// Whether the picture has an alpha channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Alpha {
    /// Opaque: red, green, blue.
    Opaque,
    /// Straight (not premultiplied) alpha beside red, green and blue.
    Straight,
}

/// The film as the bytes of a PNG file, sRGB encoded. No date goes in: the same picture is the same file.
pub fn encode_png(film: &Film, depth: BitDepth, alpha: Alpha) -> io::Result<Vec<u8>> {
    let samples = match depth {
        BitDepth::Eight => keep(film.to_rgba8(), alpha),
        BitDepth::Sixteen => keep(film.to_rgba16(), alpha).into_iter().flat_map(u16::to_be_bytes).collect(),
    };
    encode_samples((film.width_px(), film.height_px()), depth, alpha, &samples)
}

fn keep<T: Copy>(rgba: Vec<T>, alpha: Alpha) -> Vec<T> {
    match alpha {
        Alpha::Straight => rgba,
        Alpha::Opaque => rgba.chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect(),
    }
}

fn encode_samples(size: (u32, u32), depth: BitDepth, alpha: Alpha, samples: &[u8]) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, size.0, size.1);
    encoder.set_color(match alpha {
        Alpha::Opaque => png::ColorType::Rgb,
        Alpha::Straight => png::ColorType::Rgba,
    });
    encoder.set_depth(match depth {
        BitDepth::Eight => png::BitDepth::Eight,
        BitDepth::Sixteen => png::BitDepth::Sixteen,
    });
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.add_text_chunk("Software".into(), concat!("octrace ", env!("CARGO_PKG_VERSION")).into())?;
    let mut writer = encoder.write_header()?;
    writer.write_image_data(samples)?;
    writer.finish()?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sixteen_bits_and_alpha_come_back_as_they_went_in() {
        let samples: Vec<u8> = (0..2 * 3 * 8).collect();
        let file = encode_samples((2, 3), BitDepth::Sixteen, Alpha::Straight, &samples).unwrap();
        let mut reader = png::Decoder::new(io::Cursor::new(file)).read_info().unwrap();
        assert!(reader.info().srgb.is_some());
        assert!(reader.info().uncompressed_latin1_text[0].text.starts_with("octrace "));
        let mut read = vec![0; reader.output_buffer_size().unwrap()];
        let frame = reader.next_frame(&mut read).unwrap();
        assert_eq!((frame.width, frame.height, frame.color_type), (2, 3, png::ColorType::Rgba));
        assert_eq!(read, samples);
    }

    #[test]
    fn opaque_pictures_have_no_alpha() {
        assert_eq!(keep(vec![1, 2, 3, 4, 5, 6, 7, 8], Alpha::Opaque), [1, 2, 3, 5, 6, 7]);
    }
}
