//! Colours: by name, and what rock is drawn in when its facies has none of its own.
//!
//! The names are those of the web (CSS Color Module, level 4), as far as anybody writes them by hand. Rock takes the colours that
//! geological maps and logs have it in: sand yellow, mud grey, coal black, limestone blue, salt pink.

use super::facies::Rgb;

/// A word with red, green and blue.
type Named = (&'static str, u32);

/// Colours that have a name; in order of the alphabet.
const NAMES: [Named; 72] = [
    ("aqua", 0x00_ff_ff),
    ("beige", 0xf5_f5_dc),
    ("black", 0x00_00_00),
    ("blue", 0x00_00_ff),
    ("brown", 0xa5_2a_2a),
    ("burlywood", 0xde_b8_87),
    ("chocolate", 0xd2_69_1e),
    ("coral", 0xff_7f_50),
    ("crimson", 0xdc_14_3c),
    ("cyan", 0x00_ff_ff),
    ("darkblue", 0x00_00_8b),
    ("darkcyan", 0x00_8b_8b),
    ("darkgoldenrod", 0xb8_86_0b),
    ("darkgray", 0xa9_a9_a9),
    ("darkgreen", 0x00_64_00),
    ("darkgrey", 0xa9_a9_a9),
    ("darkkhaki", 0xbd_b7_6b),
    ("darkolivegreen", 0x55_6b_2f),
    ("darkorange", 0xff_8c_00),
    ("darkred", 0x8b_00_00),
    ("darkslategray", 0x2f_4f_4f),
    ("darkslategrey", 0x2f_4f_4f),
    ("dimgray", 0x69_69_69),
    ("dimgrey", 0x69_69_69),
    ("firebrick", 0xb2_22_22),
    ("forestgreen", 0x22_8b_22),
    ("fuchsia", 0xff_00_ff),
    ("gold", 0xff_d7_00),
    ("goldenrod", 0xda_a5_20),
    ("gray", 0x80_80_80),
    ("green", 0x00_80_00),
    ("grey", 0x80_80_80),
    ("indigo", 0x4b_00_82),
    ("ivory", 0xff_ff_f0),
    ("khaki", 0xf0_e6_8c),
    ("lavender", 0xe6_e6_fa),
    ("lightblue", 0xad_d8_e6),
    ("lightgray", 0xd3_d3_d3),
    ("lightgreen", 0x90_ee_90),
    ("lightgrey", 0xd3_d3_d3),
    ("lightyellow", 0xff_ff_e0),
    ("lime", 0x00_ff_00),
    ("magenta", 0xff_00_ff),
    ("maroon", 0x80_00_00),
    ("navy", 0x00_00_80),
    ("olive", 0x80_80_00),
    ("orange", 0xff_a5_00),
    ("orchid", 0xda_70_d6),
    ("palegoldenrod", 0xee_e8_aa),
    ("peru", 0xcd_85_3f),
    ("pink", 0xff_c0_cb),
    ("plum", 0xdd_a0_dd),
    ("purple", 0x80_00_80),
    ("red", 0xff_00_00),
    ("rosybrown", 0xbc_8f_8f),
    ("royalblue", 0x41_69_e1),
    ("salmon", 0xfa_80_72),
    ("sandybrown", 0xf4_a4_60),
    ("seagreen", 0x2e_8b_57),
    ("sienna", 0xa0_52_2d),
    ("silver", 0xc0_c0_c0),
    ("skyblue", 0x87_ce_eb),
    ("slategray", 0x70_80_90),
    ("slategrey", 0x70_80_90),
    ("steelblue", 0x46_82_b4),
    ("tan", 0xd2_b4_8c),
    ("teal", 0x00_80_80),
    ("turquoise", 0x40_e0_d0),
    ("violet", 0xee_82_ee),
    ("wheat", 0xf5_de_b3),
    ("white", 0xff_ff_ff),
    ("yellow", 0xff_ff_00),
];

const SAND: u32 = 0xe6_c2_5c;
const FINE_SAND: u32 = 0xf0_dc_9a;
const COARSE: u32 = 0xcf_8f_3f;
const SILT: u32 = 0xbf_ae_8a;
const MUD: u32 = 0x9a_94_88;
const SHALE: u32 = 0x74_70_69;
const SOIL: u32 = 0xa3_8a_63;
const COAL: u32 = 0x2e_2b_29;
const LIME: u32 = 0x7d_b0_cf;
const DOLOMITE: u32 = 0xa9_92_c6;
const CHALK: u32 = 0xd7_e3_cf;
const SALT: u32 = 0xe3_a6_b4;
const VOLCANIC: u32 = 0x8c_4f_44;
const CRYSTALLINE: u32 = 0xcf_8e_86;
const CEMENT: u32 = 0x5b_8a_a6;

/// Words in the names of facies, and what they are drawn in.
const ROCKS: [Named; 81] = [
    ("sand", SAND),
    ("sands", SAND),
    ("sandstone", SAND),
    ("sandstones", SAND),
    ("sandbody", SAND),
    ("arenite", SAND),
    ("quartzite", SAND),
    ("arkose", SAND),
    ("turbidite", SAND),
    ("channel", SAND),
    ("bar", SAND),
    ("shoreface", SAND),
    ("foreshore", SAND),
    ("beach", SAND),
    ("dune", SAND),
    ("usf", SAND),
    ("lobe", SAND),
    ("crevasse", FINE_SAND),
    ("splay", FINE_SAND),
    ("levee", FINE_SAND),
    ("lsf", FINE_SAND),
    ("plsf", FINE_SAND),
    ("dlsf", SILT),
    ("fringe", FINE_SAND),
    ("heterolithic", FINE_SAND),
    ("heterolithics", FINE_SAND),
    ("gravel", COARSE),
    ("gravels", COARSE),
    ("pebbles", COARSE),
    ("conglomerate", COARSE),
    ("breccia", COARSE),
    ("lag", COARSE),
    ("rudite", COARSE),
    ("silt", SILT),
    ("silts", SILT),
    ("siltstone", SILT),
    ("loess", SILT),
    ("mud", MUD),
    ("muds", MUD),
    ("mudstone", MUD),
    ("mudrock", MUD),
    ("clay", MUD),
    ("claystone", MUD),
    ("floodplain", MUD),
    ("overbank", MUD),
    ("offshore", MUD),
    ("os", MUD),
    ("lagoon", MUD),
    ("prodelta", MUD),
    ("plug", SHALE),
    ("drape", SHALE),
    ("shale", SHALE),
    ("shales", SHALE),
    ("slate", SHALE),
    ("soil", SOIL),
    ("paleosol", SOIL),
    ("palaeosol", SOIL),
    ("coal", COAL),
    ("peat", COAL),
    ("lignite", COAL),
    ("limestone", LIME),
    ("carbonate", LIME),
    ("carbonates", LIME),
    ("grainstone", LIME),
    ("packstone", LIME),
    ("wackestone", LIME),
    ("reef", LIME),
    ("dolomite", DOLOMITE),
    ("dolostone", DOLOMITE),
    ("chalk", CHALK),
    ("marl", CHALK),
    ("salt", SALT),
    ("halite", SALT),
    ("anhydrite", SALT),
    ("gypsum", SALT),
    ("evaporite", SALT),
    ("basalt", VOLCANIC),
    ("tuff", VOLCANIC),
    ("granite", CRYSTALLINE),
    ("basement", CRYSTALLINE),
    ("cement", CEMENT),
];

/// Colours of facies whose names say nothing, in turn: muted, and told apart without red against green.
const PALETTE: [u32; 8] = [
    0xe6_c2_5c, 0x9a_8f_78, 0x5b_8a_a6, 0xb8_6b_4b, 0x7d_9b_5f, 0x8a_6f_9e, 0xd8_a4_87, 0x4f_5d_6b,
];

/// How much of the way to white (above 0) or to black goes the colour of each further facies of one kind of rock.
const SHADES: [f64; 5] = [0.0, 0.35, -0.2, 0.6, -0.4];

/// The colour of this name.
pub(crate) fn named(name: &str) -> Option<Rgb> {
    look_up(&NAMES, name)
}

/// The names of all colours.
pub(crate) fn names() -> Vec<&'static str> {
    NAMES.iter().map(|(name, _)| *name).collect()
}

/// Colours of facies that have none of their own: by what rock their names say, each further one of a rock in another shade;
/// from the palette where they say nothing.
pub(crate) fn of_facies(names: &[&str]) -> Vec<Rgb> {
    let rocks: Vec<Option<u32>> = names.iter().map(|name| rock(name)).collect();
    rocks
        .iter()
        .enumerate()
        .map(|(at, found)| {
            let Some(color) = *found else {
                return rgb(PALETTE[at % PALETTE.len()]);
            };
            let like = rocks[..at].iter().filter(|other| **other == Some(color));
            shaded(rgb(color), SHADES[like.count() % SHADES.len()])
        })
        .collect()
}

/// The colour of the rock that a facies' name says: the last word that is one, since a sandy mud is a mud.
fn rock(name: &str) -> Option<u32> {
    let lower = name.to_lowercase();
    let words = lower.split(|c: char| !c.is_alphabetic());
    let of = |word: &str| ROCKS.iter().find(|(rock, _)| *rock == word);
    words.rev().find_map(of).map(|(_, color)| *color)
}

fn look_up(list: &[Named], word: &str) -> Option<Rgb> {
    let (_, color) = list.iter().find(|(name, _)| *name == word)?;
    Some(rgb(*color))
}

fn rgb(color: u32) -> Rgb {
    let [_, r, g, b] = color.to_be_bytes();
    Rgb { r, g, b }
}

/// Part of the way to white, or to black if that is below 0.
fn shaded(color: Rgb, part: f64) -> Rgb {
    let end = if part > 0.0 { 255.0 } else { 0.0 };
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between two values of a channel"
    )]
    let channel = |value: u8| {
        let value = f64::from(value);
        (value + (end - value) * part.abs()).round() as u8
    };
    Rgb {
        r: channel(color.r),
        g: channel(color.g),
        b: channel(color.b),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::panic, reason = "a test fails by panicking")]

    use super::{NAMES, ROCKS, Rgb, named, of_facies};

    #[test]
    fn sand_is_yellow_mud_is_grey_and_coal_is_black() {
        let [sand, mud, coal, lime] = of_facies(&["sand", "mud", "coal", "limestone"])[..] else {
            panic!("four were asked for");
        };
        assert!(sand.r > 200 && sand.g > 160 && sand.b < 120, "{sand:?}");
        let spread = mud.r.max(mud.g).max(mud.b) - mud.r.min(mud.g).min(mud.b);
        assert!(spread < 30 && (100..200).contains(&mud.g), "{mud:?}");
        assert!(coal.r < 60 && coal.g < 60 && coal.b < 60, "{coal:?}");
        assert!(lime.b > lime.r, "{lime:?}");
    }

    #[test]
    fn the_last_word_that_is_a_rock_decides_whatever_separates_the_words() {
        let one = |name: &str| of_facies(&[name])[0];
        assert_eq!(one("sandy-mud"), one("mud"));
        assert_eq!(one("channel_sand_2"), one("sand"));
        assert_eq!(one("Mud-Drape"), one("shale"));
        assert_eq!(one("sand-a"), one("sand"));
        // A word that only begins like a rock is none.
        assert_ne!(of_facies(&["mud", "sandal"])[1], one("sand"));
    }

    #[test]
    fn facies_of_one_rock_have_different_shades_of_its_colour() {
        let names = [
            "upper-sand",
            "lower-sand",
            "a",
            "old-sand",
            "sand-4",
            "sand-5",
        ];
        let colors = of_facies(&names);
        for (at, color) in colors.iter().enumerate() {
            assert!(!colors[..at].contains(color), "{}: {color:?}", names[at]);
        }
    }

    #[test]
    fn colours_have_names_of_their_own_and_those_of_the_web() {
        for list in [&NAMES[..], &ROCKS[..]] {
            for (at, (name, _)) in list.iter().enumerate() {
                assert!(list[..at].iter().all(|(other, _)| other != name), "{name}");
            }
        }
        assert!(NAMES.is_sorted());
        let gold = Rgb {
            r: 255,
            g: 215,
            b: 0,
        };
        assert_eq!(named("gold"), Some(gold));
        assert_eq!(named("grey"), named("gray"));
        assert_eq!(named("yelow"), None);
    }
}
