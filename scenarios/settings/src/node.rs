//! A part of a JSON Schema: what a value must be.

use serde_json::{Map, Value};

/// A part of a schema.
#[derive(Clone, Copy)]
pub(super) struct Node<'s>(pub &'s Value);

/// A key of a table that another value of the table's tag would allow.
#[derive(Clone, Copy)]
pub(super) struct Foreign<'s> {
    pub key: &'s str,
    pub node: Node<'s>,
    pub tag: &'s str,
    pub owner: &'s str,
}

/// The keys of a table, given its content.
#[derive(Default)]
pub(super) struct Keys<'s> {
    pub own: Vec<(&'s str, Node<'s>)>,
    pub foreign: Vec<Foreign<'s>>,
    /// The tags that select `own`, each with its present value.
    pub tags: Vec<(&'s str, &'s str)>,
    /// Those of them that are neither given nor have a default.
    pub assumed: Vec<&'s str>,
}

impl<'s> Keys<'s> {
    pub fn own(&self, key: &str) -> Option<Node<'s>> {
        self.own.iter().find(|(name, _)| *name == key).map(|(_, node)| *node)
    }

    pub fn foreign(&self, key: &str) -> impl Iterator<Item = &Foreign<'s>> {
        self.foreign.iter().filter(move |foreign| foreign.key == key)
    }
}

impl<'s> Node<'s> {
    pub fn get(self, key: &str) -> Option<&'s Value> {
        self.0.get(key)
    }

    pub fn text(self, key: &str) -> Option<&'s str> {
        self.get(key).and_then(Value::as_str)
    }

    pub fn number(self, key: &str) -> Option<f64> {
        self.get(key).and_then(Value::as_f64)
    }

    fn list(self, key: &str) -> impl Iterator<Item = Node<'s>> {
        self.get(key).and_then(Value::as_array).into_iter().flatten().map(Node)
    }

    /// Its `type`, of several the first that is not null.
    pub fn kind(self) -> Option<&'s str> {
        match self.get("type")? {
            Value::Array(kinds) => kinds.iter().filter_map(Value::as_str).find(|kind| *kind != "null"),
            kind => kind.as_str(),
        }
    }

    /// The value that a default gives; none for null.
    pub fn default(self) -> Option<&'s Value> {
        self.get("default").filter(|value| !value.is_null())
    }

    /// The part for a value that is given, and the word that stands for an absent key.
    pub fn given(self) -> (Node<'s>, Option<&'s str>) {
        let mut word = None;
        let mut value = self;
        for option in self.list("anyOf") {
            match (option.words_of_option().as_slice(), option.kind()) {
                ([text], _) => word = Some(*text),
                (_, Some("null")) => {}
                _ => value = option,
            }
        }
        (value, word)
    }

    /// The parts of a choice between values of several kinds, such as a text or a list of texts; none of anything else.
    pub fn kinds_of_values(self) -> Vec<Node<'s>> {
        let parts = self.list("anyOf").flat_map(|part| match part.kinds_of_values() {
            none if none.is_empty() => vec![part],
            several => several,
        });
        let is_kind =
            |part: &Node| part.kind() != Some("null") && part.words().is_empty() && part.text("const").is_none();
        let parts: Vec<Node> = parts.filter(|part| is_kind(part) && part.tag().is_none()).collect();
        if parts.len() > 1 { parts } else { Vec::new() }
    }

    /// What each key of a table may be whose keys are free.
    pub fn free_key(self) -> Option<Node<'s>> {
        self.get("additionalProperties").filter(|node| **node != Value::Bool(false)).map(Node)
    }

    /// The words that it allows; none where it is not a choice of words.
    pub fn words(self) -> Vec<&'s str> {
        let listed = self.get("enum").and_then(Value::as_array).into_iter().flatten().filter_map(Value::as_str);
        listed.chain(self.list("oneOf").flat_map(|option| option.words_of_option())).collect()
    }

    /// The words that may be given, that for an absent key among them; none where other values may be given too.
    pub fn given_words(self) -> Vec<&'s str> {
        let (inner, word) = self.given();
        let words = inner.words();
        if words.is_empty() { words } else { words.into_iter().chain(word).collect() }
    }

    /// The words that may be given beside a number, each with a meaning of its own.
    pub fn words_beside_number(self) -> Vec<&'s str> {
        let options = self.list("anyOf").map(Node::words_of_option).filter(|words| words.len() > 1);
        if self.given().0.kind() == Some("number") { options.flatten().collect() } else { Vec::new() }
    }

    fn words_of_option(self) -> Vec<&'s str> {
        match self.text("const") {
            Some(word) => vec![word],
            None => {
                self.get("enum").and_then(Value::as_array).into_iter().flatten().filter_map(Value::as_str).collect()
            }
        }
    }

    /// The constant key that tells a variant of a table from the others, and its value.
    fn tag(self) -> Option<(&'s str, &'s str)> {
        let properties = self.get("properties")?.as_object()?;
        properties.iter().find_map(|(key, node)| Some((key.as_str(), Node(node).text("const")?)))
    }

    /// The variants of a table, each with its tag's key and value.
    fn variants(self) -> impl Iterator<Item = (Node<'s>, &'s str, &'s str)> {
        self.list("oneOf").chain(self.list("anyOf")).filter_map(|variant| {
            let (tag, value) = variant.tag()?;
            Some((variant, tag, value))
        })
    }

    /// The key that selects among this table's variants.
    pub fn tag_name(self) -> Option<&'s str> {
        self.variants().next().map(|(_, tag, _)| tag)
    }

    /// The keys of a table with this content.
    pub fn keys(self, content: &Map<String, Value>) -> Keys<'s> {
        let mut keys = Keys::default();
        self.collect(content, &mut keys);
        keys
    }

    fn collect(self, content: &Map<String, Value>, keys: &mut Keys<'s>) {
        let properties = self.get("properties").and_then(Value::as_object);
        keys.own.extend(properties.into_iter().flatten().map(|(key, node)| (key.as_str(), Node(node))));
        self.list("allOf").for_each(|part| part.collect(content, keys));
        let usual = self.text("x-tag-default");
        let given = |tag: &str| content.get(tag).and_then(Value::as_str).or(usual);
        let chosen = self.variants().find(|(_, tag, value)| given(tag) == Some(value));
        let Some((variant, tag, value)) = chosen.or_else(|| self.variants().next()) else { return };
        if chosen.is_none() {
            keys.assumed.push(tag);
        }
        keys.tags.push((tag, value));
        let before = keys.own.len();
        variant.collect(content, keys);
        // the tag itself takes the words of all variants
        keys.own.iter_mut().skip(before).filter(|(key, _)| *key == tag).for_each(|(_, node)| *node = self);
        for (other, tag, owner) in self.variants().filter(|(_, _, other)| *other != value) {
            let mut theirs = Keys::default();
            other.collect(content, &mut theirs);
            let theirs = theirs.own.into_iter().filter(|(key, _)| *key != tag);
            keys.foreign.extend(theirs.map(|(key, node)| Foreign { key, node, tag, owner }));
        }
    }

    /// The values of the tag that selects among this table's variants.
    pub fn tag_words(self) -> Vec<&'s str> {
        self.variants().map(|(_, _, value)| value).collect()
    }

    /// The values of the tags under which this table, or a table of it, has the key.
    pub fn owners(self, key: &str) -> Vec<&'s str> {
        let has = |node: Node| node.get("properties").is_some_and(|properties| properties.get(key).is_some());
        let own = self.variants().filter(|(variant, ..)| has(*variant)).map(|(_, _, value)| value);
        own.chain(self.list("allOf").flat_map(|part| part.owners(key))).collect()
    }

    /// True if this table, or a variant of it, requires the key.
    pub fn requires(self, key: &str) -> bool {
        let required = self.get("required").and_then(Value::as_array).into_iter().flatten();
        let own = required.filter_map(Value::as_str).any(|name| name == key);
        own || ["oneOf", "anyOf", "allOf"].iter().any(|list| self.list(list).any(|part| part.requires(key)))
    }

    /// What it takes, in words.
    pub fn expected(self) -> String {
        if let Some(text) = self.text("x-takes") {
            return text.to_string();
        }
        let kinds = self.kinds_of_values();
        if !kinds.is_empty() {
            return kinds.into_iter().map(Node::expected).collect::<Vec<_>>().join(" or ");
        }
        let (node, word) = self.given();
        let or_word = word.map_or(String::new(), |word| format!(" or {word:?}"));
        let words: Vec<String> = self.given_words().iter().map(|word| format!("`{word}`")).collect();
        if !words.is_empty() {
            return format!("one of {}", words.join(", "));
        }
        let plain = match node.kind() {
            Some("number") if self.is_bounded() => self.number_range("number"),
            Some("number") => node.number_range("number"),
            Some("integer") if word.is_some() && self.is_bounded() => self.number_range("whole number"),
            Some("integer") => node.whole_range(),
            Some("boolean") => "true or false".into(),
            Some("string") => "a string".into(),
            Some("object") => "a table of keys".into(),
            Some("array") => node.list_expected(word.is_some()),
            _ => "a value".into(),
        };
        let beside: Vec<String> = self.words_beside_number().iter().map(|word| format!(" or {word:?}")).collect();
        plain + &or_word + &beside.concat()
    }

    fn list_expected(self, short: bool) -> String {
        let items = self.get("items").map(Node);
        let length = self.number("minItems").filter(|least| self.number("maxItems") == Some(*least));
        match (length, items.and_then(Node::kind)) {
            (Some(2.0), _) if short => "two numbers".into(),
            (Some(length), _) => format!("an array of length {length}"),
            (None, Some("string")) if self.number("minItems") == Some(1.0) => "a list of at least one".into(),
            (None, Some("object")) => "a list (of tables: a heading in double brackets, [[...]])".into(),
            (None, _) => "a list".into(),
        }
    }

    fn whole_range(self) -> String {
        match (self.number("minimum"), self.number("maximum"), self.text("format")) {
            (Some(0.0), None, Some("uint32")) => format!("a whole number from 0 to {}", u32::MAX),
            _ => self.number_range("whole number"),
        }
    }

    fn number_range(self, noun: &str) -> String {
        let [above, least, below, most] =
            ["exclusiveMinimum", "minimum", "exclusiveMaximum", "maximum"].map(|key| self.number(key));
        match (above, least, below, most) {
            (Some(0.0), None, None, None) => format!("a finite {noun} above 0"),
            (None, None, None, None) => format!("a {noun}"),
            (None, Some(least), None, Some(most)) => format!("a {noun} from {least} to {most}"),
            _ => {
                let low = above.map(|x| format!("above {x}")).or(least.map(|x| format!("of at least {x}")));
                let high = below.map(|x| format!("below {x}")).or(most.map(|x| format!("up to {x}")));
                let bounds: Vec<String> = low.into_iter().chain(high).collect();
                format!("a {noun} {}", bounds.join(" and "))
            }
        }
    }

    fn is_bounded(self) -> bool {
        ["exclusiveMinimum", "minimum", "exclusiveMaximum", "maximum"].iter().any(|key| self.get(key).is_some())
    }

    /// True for a number within its bounds.
    pub fn allows_number(self, x: f64) -> bool {
        let holds = |key: &str, fits: fn(f64, f64) -> bool| self.number(key).is_none_or(|bound| fits(x, bound));
        holds("exclusiveMinimum", |x, bound| x > bound)
            && holds("minimum", |x, bound| x >= bound)
            && holds("exclusiveMaximum", |x, bound| x < bound)
            && holds("maximum", |x, bound| x <= bound)
    }
}
