"""Refuses what meshio reads otherwise than Abaqus does, without a word: it keeps the last *NODE card and the last set of a name,
passes over cards that it does not know, and ends a card at a comment."""
import sys

FLAT = "expected flat input (Abaqus/CAE: Model > Edit Attributes > Do not use parts and assemblies)"
OTHERS = {"INCLUDE": "of another file", **dict.fromkeys(("NGEN", "NFILL", "NCOPY", "NMAP", "SYSTEM"), "of nodes"),
          **dict.fromkeys(("ELGEN", "ELCOPY"), "of elements")}
READ = ("NODE", "ELEMENT", "NSET", "ELSET")


class Card:
    def __init__(self, number, line):
        word, *parameters = line[1:].split(",")
        self.number, self.word = number, " ".join(word.upper().split())
        pairs = [parameter.partition("=") for parameter in parameters]
        self.values = {key.strip().upper(): value.strip() for key, _, value in pairs}
        self.first = self.comment = self.cut = None  # a line of data; of a comment; of data behind the comment


def cards_of(path):
    cards = []
    with open(path, errors="replace") as file:
        for number, line in enumerate(file, 1):
            if line.startswith("**"):
                if cards:
                    cards[-1].comment = number
            elif line.startswith("*"):
                cards.append(Card(number, line))
            elif line.strip() and cards:
                cards[-1].first = cards[-1].first or line.strip()
                cards[-1].cut = cards[-1].cut or (cards[-1].comment and number)
    return cards


def check(path, element_sets=False, end=sys.exit):
    """Ends the program if the nodes, elements or sets of nodes would be others; also those of elements, if they are used."""
    named = {}  # the card of each set
    for card in cards_of(path):
        if problem := problem_of(card, named, element_sets):
            end(f"{path}, line {card.number}: {problem}")


def problem_of(card, named, element_sets):
    word, values = card.word, card.values
    if word in OTHERS:
        return f"*{word}, a card {OTHERS[word]} that meshio does not read as Abaqus does; expected all nodes and elements in one file"
    if word == "INSTANCE" and card.first:
        return f"*INSTANCE moves its part by '{card.first}', which meshio does not read; {FLAT}"
    if word in ("NODE", "PART", "INSTANCE"):
        if word in named:
            return f"a second *{word}, the first is in line {named[word].number}: meshio keeps the nodes of the last one; {FLAT}"
        named[word] = card
    if word == "NODE" and values.get("SYSTEM", "R").upper() != "R":
        return f"*NODE has SYSTEM={values['SYSTEM']}; expected Cartesian coordinates"
    if word == "NODE" and "NSET" in values:
        return f"*NODE has NSET={values['NSET']}, a set that meshio does not read; expected a card *NSET"
    if word in READ and card.cut:
        return (f"meshio ends *{word} at the comment in line {card.comment}, and line {card.cut} would be missing; expected no "
                "comment between the lines of a card")
    if word == "NSET":
        return problem_of_set(card, word, values.get("NSET", ""), named)
    if element_sets and word == "ELSET":
        return problem_of_set(card, word, values.get("ELSET", ""), named)
    return problem_of_elements(card, named) if element_sets and word == "ELEMENT" else None


def problem_of_set(card, word, name, named):
    first = named.setdefault((word, name.upper()), card)  # for Abaqus names in capitals are the same
    if first is not card:
        return f"*{word} {name} is also in line {first.number}: Abaqus joins them, meshio does not; expected each set once"
    if not card.first or not card.first.split(",")[0].strip().isdecimal():
        return f"*{word} {name} is not made of numbers; expected those of its {'nodes' if word == 'NSET' else 'elements'}"
    return None


def problem_of_elements(card, named):
    """meshio counts the cards that have a set, and takes the count for that of all."""
    name = card.values.get("ELSET")
    if name is None:
        named["without"] = card
        return None
    first = named.setdefault(("ELSET", name.upper()), card)
    if first is not card:
        return f"*ELEMENT with ELSET={name}, which is also in line {first.number}; expected each set in one card"
    if "without" in named:
        return (f"*ELEMENT with ELSET={name}, and in line {named['without'].number} one without: meshio would mix them up; expected "
                "all with, or all without")
    return None
