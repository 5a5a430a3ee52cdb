#!/usr/bin/env python3
"""Makes nouns.tsv and english.txt from WordNet and SCOWL, as Debian packages them (README.md says which).

    apt-get install wordnet-base wamerican wbritish wamerican-small wbritish-small wamerican-large wbritish-large
    corpus/vocabulary/build.py

Everything is decided by rules and by the two files a person writes: classes.tsv and exceptions.tsv.
The same packages give the same bytes.
"""

import collections
import pathlib
import re
import sys
import zlib

HERE = pathlib.Path(__file__).resolve().parent
LEXICON = HERE.parent / "lexicon"
WORDNET = pathlib.Path("/usr/share/wordnet")
WORD_LISTS = pathlib.Path("/usr/share/dict")

# Nouns of more words are definitions rather than names.
MOST_WORDS = 3
# A word that is used as this thing less often than once in so many times is taken for something else.
LEAST_SHARE = 0.25
# Below so many tagged uses the counts say nothing.
LEAST_USES = 6
# As this, only the first sense is meant.
FIRST_SENSE_ONLY = {"person", "animal", "body_part"}
# In a home a word that names both means the thing ("printer", "nail"), unless it is used for the other this much more.
LIVING = {"person", "animal", "body_part", "plant"}
MUCH_MORE = 4
# So many senses are looked at for that thing.
SENSES_FOR_THINGS = 4
# What has more kinds than this names none of them: "equipment", "device".
MOST_KINDS = 60
# Of these there are thousands that nobody names in a home: only everyday ones.
EVERYDAY_ONLY = {"person", "animal", "body_part", "plant"}
# What has a colour's name is a colour before it is a thing, unless people eat or water it.
BEFORE_COLOR = {"food", "drink", "plant"}
# How WordNet marks what nobody should hear from a program.
COARSE = re.compile(r"obscen|slur|vulgar|disparag|offensive (term|name|word)|derogat|pejorative")


def wordnet_lines(name):
    """The lines of a WordNet file without the licence at its head."""
    with open(WORDNET / name, encoding="ascii") as file:
        return [line for line in file if not line.startswith("  ")]


def read_synsets():
    """Hypernyms of each noun synset, by offset."""
    parents = {}
    for line in wordnet_lines("data.noun"):
        fields = line.split(" | ")[0].split()
        pointers = fields[4 + 2 * int(fields[3], 16) :]
        count = int(pointers[0])
        pairs = [(pointers[1 + 4 * i], pointers[2 + 4 * i]) for i in range(count)]
        parents[fields[0]] = [offset for kind, offset in pairs if kind == "@"]
    return parents


def read_unfit():
    """Pairs of synset and lemma that are proper names (written with a capital), and synsets of coarse words."""
    names, coarse = set(), set()
    for line in wordnet_lines("data.noun"):
        fields, gloss = line.split(" | ")
        fields = fields.split()
        words = fields[4 : 4 + 2 * int(fields[3], 16) : 2]
        names.update((fields[0], word.lower()) for word in words if word != word.lower())
        if COARSE.search(gloss):
            coarse.add(fields[0])
    return names, coarse


def read_index():
    """Offsets of the senses of each noun, the usual one first."""
    index = {}
    for line in wordnet_lines("index.noun"):
        fields = line.split()
        index[fields[0]] = fields[-int(fields[2]) :]
    return index


def read_uses():
    """Tagged uses of a lemma: by sense of the noun, as an adjective, and of all parts of speech together."""
    of_sense, as_adjective, in_all = collections.Counter(), collections.Counter(), collections.Counter()
    with open(WORDNET / "cntlist.rev", encoding="ascii") as file:
        for line in file:
            key, number, count = line.split()
            lemma, rest = key.split("%")
            in_all[lemma] += int(count)
            if rest.startswith("1:"):
                of_sense[lemma, int(number)] += int(count)
            elif rest.startswith(("3:", "5:")):
                as_adjective[lemma] += int(count)
    return of_sense, as_adjective, in_all


def table(path):
    """Fields of the lines of a file that a person writes."""
    lines = path.read_text(encoding="utf-8").splitlines()
    return [line.split("\t") for line in lines if line and not line.startswith("#")]


def read_classes(index):
    """Synset offset to class."""
    classes = {}
    for name, lemma, number in table(HERE / "classes.tsv"):
        senses = index.get(lemma, [])
        if not 1 <= int(number) <= len(senses):
            sys.exit(f"classes.tsv: WordNet has no sense {number} of `{lemma}`")
        offset = senses[int(number) - 1]
        if classes.setdefault(offset, name) != name:
            sys.exit(f"classes.tsv: sense {number} of `{lemma}` has two classes")
    return classes


def class_of(synset, parents, classes):
    """The class of the nearest hypernym that has one; of several as near, the first in the order of the file."""
    order = {name: i for i, name in enumerate(dict.fromkeys(classes.values()))}
    level, seen = [synset], set()
    while level:
        found = {classes[offset] for offset in level if offset in classes}
        if found:
            best = min(found, key=order.get)
            return None if best == "-" else best
        seen.update(level)
        level = [up for offset in level for up in parents[offset] if up not in seen]
    return None


def children_of(parents):
    """Hyponyms of each synset."""
    children = collections.defaultdict(list)
    for offset, ups in parents.items():
        for up in ups:
            children[up].append(offset)
    return children


def below(root, children):
    """The synsets under a synset, and itself."""
    found, todo = set(), [root]
    while todo:
        offset = todo.pop()
        if offset not in found:
            found.add(offset)
            todo.extend(children[offset])
    return found


def word_list(size):
    """SCOWL's words of American and British English, in lower case: all, and those that are no proper names."""
    lines = []
    for country in ("american", "british"):
        lines += (WORD_LISTS / f"{country}-english{size}").read_text(encoding="utf-8").splitlines()
    words = [word for word in lines if re.fullmatch(r"[A-Za-z]+", word)]
    return {word.lower() for word in words}, {word for word in words if word.islower()}


def other_words():
    """What the lexicon reads as something else than a noun: "left", "can", "will"."""
    return {fields[0] for fields in table(LEXICON / "words.tsv")}


class Chooser:
    """Which class, if any, a lemma has."""

    def __init__(self):
        self.parents, self.index = read_synsets(), read_index()
        self.children = children_of(self.parents)
        self.of_sense, self.as_adjective, self.in_all = read_uses()
        self.classes = read_classes(self.index)
        self.proper, self.coarse = read_unfit()
        self.everyday = word_list("-small")[1]
        self.usual = self.everyday | word_list("")[1] | word_list("-large")[1]
        self.others = other_words()
        colors = [self.index[name][0] for name in ("chromatic_color", "achromatic_color")]
        self.colors = set().union(*(below(color, self.children) for color in colors))

    def is_readable(self, lemma):
        """Whether it is a name of few words, each a word of English."""
        words = lemma.split("_")
        usual = all(word in self.usual for word in words) and lemma not in self.others
        return usual and len(words) <= MOST_WORDS and len(lemma) > 2

    def class_in(self, lemma, number):
        """The class of a sense of a lemma, unless it is a proper name or a kind of kinds."""
        synset = self.index[lemma][number - 1]
        name = class_of(synset, self.parents, self.classes)
        if (synset, lemma) in self.proper or synset in self.coarse:
            return None
        generic = name == "artifact" and len(below(synset, self.children)) > MOST_KINDS
        return None if generic else name

    def choose(self, lemma):
        """The class that people mean by a lemma in a home."""
        coarse = self.index[lemma][0] in self.coarse
        if coarse or not self.is_readable(lemma):
            return None
        senses = range(1, min(len(self.index[lemma]), SENSES_FOR_THINGS) + 1)
        named = [(number, self.class_in(lemma, number)) for number in senses]
        named = [(number, name) for number, name in named if name]
        # Where WordNet counted no uses its order says little.
        usual = 2 if any(self.of_sense[lemma, number] for number in senses) else SENSES_FOR_THINGS
        if not named or named[0][0] > usual:
            return None
        number, name = self.thing_instead(lemma, named)
        return name if self.is_common(lemma, number, name) else None

    def thing_instead(self, lemma, named):
        """The first sense that is a thing; or, of what lives, a later one that is a thing and common enough."""
        number, living = named[0]
        if living in LIVING:
            for other, name in named[1:]:
                eaten = name == "food" and living in ("plant", "animal")
                common = self.of_sense[lemma, other] * MUCH_MORE >= self.of_sense[lemma, number]
                if name not in LIVING and (eaten or common and living != "plant"):
                    return other, name
        return number, living

    def is_common(self, lemma, number, name):
        """Whether the word is used for this often enough."""
        if number > 1 and name in FIRST_SENSE_ONLY:
            return False
        if name in EVERYDAY_ONLY and not (lemma in self.everyday or self.of_sense[lemma, number]):
            return False
        if name not in BEFORE_COLOR and any(sense in self.colors for sense in self.index[lemma]):
            return False
        # "Sour", "flat", "sectional": describes a thing rather than names one.
        if self.as_adjective[lemma] > self.of_sense[lemma, number]:
            return False
        uses = self.in_all[lemma]
        return number > 2 or uses < LEAST_USES or self.of_sense[lemma, number] >= LEAST_SHARE * uses


def regular_singulars(plural):
    """What `singular` in src/language/vocabulary/plural.rs makes of a plural."""
    endings = [("ies", "y"), ("ves", "f"), ("ves", "fe"), ("es", ""), ("s", ""), ("men", "man")]
    return {plural[: -len(end)] + other for end, other in endings if plural.endswith(end)}


def irregular_plurals(nouns):
    """Plural to singular, of the nouns, where no rule tells."""
    plurals = {}
    for line in wordnet_lines("noun.exc"):
        plural, singular = line.split()[:2]
        regular = singular in regular_singulars(plural)
        if singular in nouns and plural not in nouns and not regular and re.fullmatch(r"[a-z]+", plural):
            plurals[plural] = singular
    return plurals


def nouns(chooser):
    """Lines of nouns.tsv."""
    classes = {lemma: chooser.choose(lemma) for lemma in chooser.index if re.fullmatch(r"[a-z_]+", lemma)}
    classes.update((word, None if name == "-" else name) for word, name in table(HERE / "exceptions.tsv"))
    classes = {lemma: name for lemma, name in classes.items() if name}
    lines = {lemma: f"{lemma}\t{name}" for lemma, name in classes.items()}
    for plural, singular in irregular_plurals(classes).items():
        lines.setdefault(plural, f"{plural}\t{classes[singular]}\t{singular}")
    # By the bytes of the word alone: that is what is searched.
    return [line for _, line in sorted(lines.items())]


def write(name, what, lines):
    """Lines under a head that says how many they are and their checksum."""
    body = "".join(line + "\n" for line in lines).encode("ascii")
    head = f"# {what} {len(lines)} {zlib.crc32(body):08x}\n"
    (HERE / name).write_bytes(head.encode("ascii") + body)
    print(f"{name}: {len(lines)} lines, {len(head) + len(body)} bytes")


def main():
    chooser = Chooser()
    found = nouns(chooser)
    write("nouns.tsv", "nouns", found)
    named = {word for line in found for word in line.split("\t")[0].split("_")}
    write("english.txt", "english", sorted(word_list("")[0] | named))
    classes = collections.Counter(line.split("\t")[1] for line in found)
    print(", ".join(f"{name} {count}" for name, count in classes.most_common()))


if __name__ == "__main__":
    main()
