//! Tips behind what the command line's parser refuses.

use clap::Command;
use clap::error::{ContextKind, ContextValue};
use scene::nearest;

/// Most keys that a tip names.
const MOST_KEYS: usize = 3;

/// Tips for a refused command line of the program; the parser's advice to pass options as values is taken away.
pub(super) fn tips(program: &Command, error: &mut clap::Error, arguments: &[String]) -> Vec<String> {
    if let Some(ContextValue::StyledStrs(mut said)) = error.remove(ContextKind::Suggested) {
        said.retain(|tip| !tip.to_string().starts_with("to pass "));
        if !said.is_empty() {
            error.insert(ContextKind::Suggested, ContextValue::StyledStrs(said));
        }
    }
    let verb = near_verb(program, error).map(|verb| format!("did you mean `splashdown {verb}`?"));
    let argument = match error.get(ContextKind::InvalidArg) {
        Some(ContextValue::String(given)) if takes_keys(program, arguments) => {
            key_option(given, arguments).or_else(|| separate_value(given, arguments))
        }
        _ => None,
    };
    verb.into_iter().chain(argument).collect()
}

/// The command that a misspelt one, or a scene in its place, may mean.
fn near_verb(program: &Command, error: &clap::Error) -> Option<String> {
    let Some(ContextValue::String(given)) = error.get(ContextKind::InvalidSubcommand) else { return None };
    if scene::builtin().iter().any(|(name, _)| name == given) || given.ends_with(".toml") {
        return Some(format!("run {given}"));
    }
    let verbs: Vec<String> = program.get_subcommands().map(|verb| verb.get_name().to_string()).collect();
    let suggested = error.get(ContextKind::SuggestedSubcommand).is_some();
    nearest(given, verbs.iter().map(String::as_str)).filter(|_| !suggested).map(String::from)
}

/// True where the command has `--set`.
fn takes_keys(program: &Command, arguments: &[String]) -> bool {
    let verb = arguments.iter().find_map(|argument| program.find_subcommand(argument));
    verb.is_some_and(|verb| verb.get_arguments().any(|argument| argument.get_long() == Some("set")))
}

/// A key of scenes that was given as an option: `--spacing 0.01`.
fn key_option(given: &str, arguments: &[String]) -> Option<String> {
    let name = given.strip_prefix("--")?.split('=').next()?.replace('-', "_");
    let words: Vec<&str> = scene::schema().keywords().iter().map(|keyword| keyword.path.as_str()).collect();
    let found: Vec<&str> = words.into_iter().filter(|path| path.rsplit('.').next() == Some(&name)).collect();
    let at = arguments.iter().position(|argument| argument.split('=').next() == given.split('=').next())?;
    let own = arguments[at].split_once('=').map(|(_, value)| value);
    let next = arguments.get(at + 1).map(String::as_str).filter(|next| !next.starts_with("--"));
    let value = own.or(next).unwrap_or("VALUE");
    let value = if value.contains([' ', '[']) { format!("'{value}'") } else { value.to_string() };
    let sets: Vec<String> = found.iter().take(MOST_KEYS).map(|path| format!("`--set {path}={value}`")).collect();
    (!sets.is_empty()).then(|| format!("a key of the scene is set by {}", sets.join(" or ")))
}

/// A value behind a space: `--set body.mass 200`.
fn separate_value(given: &str, arguments: &[String]) -> Option<String> {
    let at = arguments.windows(3).position(|w| w[0] == "--set" && !w[1].contains('=') && w[2] == given)?;
    let key = &arguments[at + 1];
    Some(format!("--set expects KEY=VALUE in one word: `--set {key}={given}`"))
}
