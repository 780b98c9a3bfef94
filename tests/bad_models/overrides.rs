//! Overrides: a defect points to the argument.

use clinothem::model::{Format, Model, Source};

use super::TOML;

#[test]
fn overrides_are_checked_and_point_to_the_argument() {
    for (argument, column, words) in [
        ("feature.chanel.width=30", 9, "no feature `chanel`"),
        ("feature.channel.widht=30", 17, "did you mean `width`?"),
        (
            "feature.channel.width=-30",
            23,
            "the width of feature \"channel\" is -30",
        ),
        ("feature.channel.width=", 23, "not valid TOML"),
        (
            "feature.channel.width.x=1",
            23,
            "holds the number 50, which has no key `x`",
        ),
        ("domain.x.3=5", 10, "`3` is no place in a list of 2"),
        ("domain.x.0=5", 10, "is no place in a list of 2"),
        ("domain.x.1=\"a\"", 12, "expected a number"),
        ("feature.channel={}", 1, "cannot be replaced as a whole"),
        ("seed", 1, "has no value"),
        ("=3", 1, "not a path of keys"),
        ("a b=3", 1, "not a path of keys"),
        ("sede=3", 1, "did you mean `seed`?"),
        ("domain.facies=clay", 15, "no facies \"clay\""),
        ("domain.z=[0,-80]", 10, "the wrong way round"),
        ("features.channel.width=30", 1, "did you mean `feature`?"),
        ("seed=3\nname=\"x\"", 1, "more than one key"),
    ] {
        let mut source = Source::from_text("good.toml", TOML, Format::Toml);
        source.set(argument);
        let defects = Model::check(&source).unwrap_err();
        let defect = defects.iter().next().unwrap();
        assert_eq!(
            (defect.place().file.as_str(), defect.place().column),
            ("--set", column),
            "{defects}"
        );
        assert!(defects.to_string().contains(words), "{argument}: {defects}");
    }
}

#[test]
fn an_entry_of_a_list_is_set_by_its_number_from_1() {
    let check = |arguments: &[&str]| {
        let mut source = Source::from_text("good.toml", TOML, Format::Toml);
        for argument in arguments {
            source.set(*argument);
        }
        Model::check(&source).unwrap()
    };
    let [before, after] = [&[][..], &["domain.x.2=4321"]].map(check);
    assert_eq!(after.domain.x, [before.domain.x[0], 4321.0]);
    assert_eq!(after.domain.y, before.domain.y);
}
