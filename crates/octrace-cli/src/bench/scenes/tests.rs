use super::*;

#[test]
fn words_are_names_or_families() {
    assert_eq!(select("classic"), Ok(SceneNames(vec!["classic"])));
    assert_eq!(select("menger"), Ok(SceneNames(vec!["menger-3", "menger-4"])));
    assert!(select("teapot").is_err() && select("").is_err());
    assert_eq!(default_names(false).len(), BUILT_IN.len());
    assert!(!default_names(true).contains(&"grid-100000"));
}
