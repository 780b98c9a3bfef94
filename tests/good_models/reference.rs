//! The reference, docs/model-file.md.

use super::check;

#[test]
fn the_examples_of_the_reference_are_good() {
    let reference = include_str!("../../docs/model-file.md");
    let blocks: Vec<&str> = reference
        .split("```toml\n")
        .skip(1)
        .map(|rest| rest.split("```").next().unwrap())
        .collect();
    let whole = blocks
        .iter()
        .find(|block| block.starts_with("name"))
        .unwrap();
    check(whole, &[]).unwrap_or_else(|defects| panic!("{defects}"));
    // Whole features follow the example's own.
    let features = blocks
        .iter()
        .filter(|block| block.starts_with("[[feature]]"));
    let mut kinds = Vec::new();
    for block in features {
        let model = check(&format!("{whole}\n{block}"), &[]);
        let model = model.unwrap_or_else(|defects| panic!("{defects}"));
        kinds.push(model.features[model.features.len() - 1].kind.name());
    }
    assert_eq!(
        kinds,
        [
            "channel",
            "meander-belt",
            "ellipsoid",
            "horizon",
            "clinoforms",
            "clinoform",
            "lag",
            "plug",
            "point-bars",
            "scour",
            "lobe",
            "lobes",
            "sheet",
            "body",
            "trend",
            "folded-beds",
            "levee",
            "splay",
            "fault",
            "fold",
            "tilt",
            "shear"
        ]
    );
    // Lines that stand for themselves are put into the whole example, one at a time.
    let mut lines = 0;
    for block in blocks
        .iter()
        .filter(|block| !block.contains("kind = \"scour\""))
    {
        for line in block.lines() {
            let key = line.split(" =").next().unwrap();
            let text = match key {
                "removes" | "removed_by" | "properties" => whole.replace("count = 5", line),
                "width" => whole.replace("width = 80", line),
                "section" => whole.replace("width = 80", &format!("width = 80\n{line}")),
                "trajectory" if !whole.contains(line) => whole.replace(
                    "trajectory = { kind = \"line\", from = [0, 300], to = [1000, 600] }",
                    line,
                ),
                _ => continue,
            };
            check(&text, &[]).unwrap_or_else(|defects| panic!("{defects}"));
            lines += 1;
        }
    }
    assert!(lines >= 15, "{lines}");
    for block in blocks.iter().filter(|block| block.starts_with("[facies")) {
        let model = check(&format!("{whole}\n{block}"), &[]);
        model.unwrap_or_else(|defects| panic!("{defects}"));
    }
}

#[test]
fn the_reference_names_every_key_of_the_schema() {
    fn keys(value: &serde_json::Value, found: &mut Vec<String>) {
        match value {
            serde_json::Value::Object(object) => {
                // Features have a key `properties` themselves: where that stands is no schema.
                if let Some(serde_json::Value::Object(properties)) = object.get("properties")
                    && !object.contains_key("id")
                {
                    found.extend(properties.keys().cloned());
                }
                object.values().for_each(|inner| keys(inner, found));
            }
            serde_json::Value::Array(values) => values.iter().for_each(|inner| keys(inner, found)),
            _ => {}
        }
    }
    let reference = include_str!("../../docs/model-file.md");
    let mut found = Vec::new();
    keys(&clinothem::model::schema(), &mut found);
    assert!(found.len() > 40);
    for key in found {
        let named = [
            format!("`{key}`"),
            format!("{key} ="),
            format!("[[{key}]]"),
            format!("[{key}]"),
            format!("[{key}.NAME]"),
        ];
        assert!(named.iter().any(|form| reference.contains(form)), "{key}");
    }
}
