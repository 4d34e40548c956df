"""The options of tools/curve, which a study may also set in a line."""
from strut_tools import Parser


def parser_of(about, kind=Parser):
    parser = kind(prog="tools/curve", description=about)
    add = parser.add_argument
    add("deck", help="the deck of the run (XML), or its history (.csv)")
    add("out", nargs="?", default=".", help="folder to write to (default: this one)")
    add("--results", default=".", metavar="FOLDER", help="that the run was started from (default: this one)")
    add("--force", metavar="COLUMN", help="of the history, N (default: its first reaction or contact force along the axis)")
    add("--other", metavar="COLUMN", help="the force at the other end, N (default: the second one)")
    add("--shortening", metavar="COLUMN|EXPRESSION", help="m (default: mean displacements, layers or the deck's motion)")
    add("--axis", choices=("x", "y", "z"), help="of compression (default: that of the force)")
    add("--block", metavar="NAME", help="that is crushed")
    add("--layers", metavar="NAME", help="profile of the history, for the front (default: the first one)")
    parser.add_numbers("--area", 1, above=0, metavar="A", help="m2, of the section (default: from the recipe or the result)")
    parser.add_numbers("--height", 1, above=0, metavar="H", help="m (default: likewise)")
    parser.add_numbers("--density", 1, above=0, metavar="RHO", help="kg/m3, of the foam (default: likewise)")
    parser.add_numbers("--smooth", 1, kind=int, above=0, metavar="N", default=1, help="mean over N rows of stress (default 1: none)")
    return parser
