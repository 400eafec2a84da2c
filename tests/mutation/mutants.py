"""Mutants of C++ source text: each is one small change of the code that its tests should notice.

The text is formatted by clang-format, so a binary operator has white space on both sides and the brackets of a template
have none. A mutant may be one that does not compile; whoever builds it finds out.
"""

import random
import re
from dataclasses import dataclass

SWAPS = {
    "relation": {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "&&": "||", "||": "&&"},
    "arithmetic": {"+": "-", "-": "+", "*": "/", "/": "*", "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*="},
}
HIDDEN = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"\(.*?\)"|"(?:\\.|[^"\\\n])*"|(?<!\w)\'(?:\\.|[^\'\\\n])\''
    r"|^[ \t]*#(?:\\\n|[^\n])*|\bstatic_assert\([^;]*;",
    re.S | re.M,
)
NUMBER = re.compile(r"(?<![\w.'])\d+\.?\d*(?:e[+-]?\d+)?(?![\w.'])")
CONDITION = re.compile(r"\b(?:if|while)(?: constexpr)? \(")
HEAD = re.compile(r"\s*(?:else\b|do\b|(?:if|for|while|switch)(?: constexpr)? (?=\()|case [^:]+:|default:|(?:public|private):)")
PLACE = r"[\w:.*>\[\]()-]+"  # what may stand left of an assignment or before the brackets of a call
REMOVABLE = re.compile(rf"{PLACE} [+*/|&-]?= .*|(?!return\b){PLACE}\(\)|throw .*|break|continue|\+\+{PLACE}|--{PLACE}", re.S)


@dataclass(frozen=True)
class Mutant:
    """The characters [start, end) of a file become `text`."""

    path: str
    start: int
    end: int
    text: str
    operator: str

    def apply(self, source):
        return source[: self.start] + self.text + source[self.end :]


def code_only(source):
    """The source with blanks, as many, in place of comments, literals and lines of the preprocessor."""
    return HIDDEN.sub(lambda match: re.sub(r"[^\n]", " ", match.group()), source)


def closing(code, opening):
    """Where the bracket that opens at `opening` is closed."""
    depth = 0
    for at in range(opening, len(code)):
        depth += (code[at] in "([{") - (code[at] in ")]}")
        if depth == 0:
            return at
    raise ValueError("a bracket is not closed")


def swapped_operators(code):
    for operator, swaps in SWAPS.items():
        for match in re.finditer(r"(?<=\s)(?:[<>=!+*/-]=|&&|\|\||[<>+*/-])(?=\s)", code):
            if match.group() in swaps:
                yield match.start(), match.end(), swaps[match.group()], operator


def changed_constants(code, source, rng):
    for match in NUMBER.finditer(code):
        number = source[match.start() : match.end()]
        changed = "1" if float(number) == 0 else rng.choice(["0", f"({number} + 1)"])
        yield match.start(), match.end(), changed, "constant"


def negated_conditions(code, source):
    for match in CONDITION.finditer(code):
        opening = match.end() - 1
        end = closing(code, opening)
        yield opening + 1, end, f"!({source[opening + 1:end]})", "condition"


def without_contents(statement):
    """The statement with nothing between its brackets."""
    kept, depth = "", 0
    for character in statement:
        depth -= character in ")]}"
        if depth == 0:
            kept += character
        depth += character in "([{"
    return kept


def after_heads(code, start, end):
    """Where the statement in [start, end) begins behind conditions, loops and labels."""
    while match := HEAD.match(code, start, end):
        start = match.end()
        if code[start : start + 1] == "(":
            start = closing(code, start) + 1
    return start + len(code[start:end]) - len(code[start:end].lstrip())


def removed_statements(code):
    start, brackets = 0, []
    for at, character in enumerate(code):
        if character in "([{":
            brackets.append(character)
        elif character in ")]}":
            brackets.pop()
        if character in "{}" or (character == ";" and (not brackets or brackets[-1] == "{")):
            begin = after_heads(code, start, at)
            if character == ";" and REMOVABLE.fullmatch(without_contents(code[begin:at])):
                yield begin, at, "", "removal"
            start = at + 1


def mutants_of(path, source, rng):
    code = code_only(source)
    found = [*swapped_operators(code), *changed_constants(code, source, rng), *negated_conditions(code, source),
             *removed_statements(code)]
    return [Mutant(path, *place) for place in sorted(found)]


def drawn(sources, seed):
    """All mutants of the sources {path: text} in an order that the seed decides."""
    rng = random.Random(seed)
    mutants = [mutant for path in sorted(sources) for mutant in mutants_of(path, sources[path], rng)]
    rng.shuffle(mutants)
    return mutants
