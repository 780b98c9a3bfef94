//! A straight channel, for tests of its sections and of what lies in it.

/// The model of a channel, 50 m wide and 4.4 m deep, that runs east through the middle of a block of 300 m by 100 m, with more features
/// behind it.
#[allow(unused_macros, reason = "not every test program has one")]
macro_rules! straight {
    ($more:literal) => {
        concat!(
            r#"
name = "Straight"
[domain]
x = [0, 300]
y = [0, 100]
z = [-20, 0]
facies = "silt"
[facies.silt]
[facies.mud]
[facies.sand]
[facies.gravel]
[[feature]]
id = "channel"
kind = "channel"
facies = "sand"
width = 50
depth = 4.4
top = -6
trajectory = { kind = "line", from = [-50, 50], to = [350, 50] }
"#,
            $more
        )
    };
}

/// The same channel along a meander with its apices in the block, which is to be wider then.
pub const MEANDER: &str = "feature.channel.trajectory={ kind = \"sine-generated\", amplitude = 30, wavelength = 300, azimuth_deg = 90, center = [150, 50], phase = 0.1 }";
/// Wide enough for that.
pub const WIDER: &str = "domain.y=[-50, 150]";
