//! What `--help` says, word for word.

mod common;

use common::Folder;

#[test]
fn help_of_every_command() {
    let folder = Folder::with(&[]);
    for (name, words) in [
        ("octrace", &["--help"][..]),
        ("render", &["render", "--help"]),
        ("check", &["check", "--help"]),
        ("measure", &["measure", "--help"]),
        ("inspect", &["inspect", "--help"]),
        ("figures", &["figures", "--help"]),
        ("study", &["study", "--help"]),
        ("bench", &["bench", "--help"]),
    ] {
        let run = folder.run(words).expect(0);
        insta::with_settings!({ omit_expression => true }, {
            insta::assert_snapshot!(format!("help_{name}"), run.text());
        });
    }
}

#[test]
fn no_arguments_show_the_way() {
    let run = Folder::with(&[]).run(&[]).expect(2);
    assert!(run.stderr.contains("Usage: octrace <COMMAND>"), "{}", run.stderr);
}
