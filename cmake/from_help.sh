#!/bin/sh
# from_help.sh VERSION STRUT OUT_MAN OUT_BASH: the man page of strut, and what bash completes, from what --help says.
set -e
version=$1 strut=$2 man=$3 bash=$4
help=$("$strut" --help) || { echo "without a man page: $strut does not start here" >&2; exit 0; }  # MPI may not allow it

# Text as it is: each line a line, nothing of it a request of troff.
as_is() { sed -e 's/\\/\\e/g' -e "s/^[.']/\\\\\\&&/" -e 's/-/\\-/g'; }
{
  echo ".TH STRUT 1 \"\" \"strut $version\" \"User Commands\""
  echo ".SH NAME"
  printf '%s\n' "$help" | sed -n '1s/^strut: /strut \\- /p'
  echo ".SH SYNOPSIS"
  echo ".nf"
  printf '%s\n' "$help" | sed -n -e 's/^usage: *//p' -e 's/^       mpirun/mpirun/p' | as_is
  echo ".fi"
  echo ".SH DESCRIPTION"
  echo ".nf"
  printf '%s\n' "$help" | sed -e '1,/^$/d' -e '/^usage: /d' -e '/^       mpirun/d' -e '/./,$!d' | as_is
  echo ".fi"
  echo ".SH SEE ALSO"
  echo "Keys of decks: strut \\-\\-keys. Pages, decks and tools: share/strut."
} > "$man"

options=$(printf '%s\n' "$help" | sed -n 's/^  \(--[a-z]*\).*/\1/p' | tr '\n' ' ')
cat > "$bash" << END
# bash completes the options of strut, and decks.
_strut() {
  local word=\${COMP_WORDS[COMP_CWORD]} before=\${COMP_WORDS[COMP_CWORD - 1]}
  case \$before in
    --log) mapfile -t COMPREPLY < <(compgen -f -- "\$word") ; return ;;
    --threads | --explain) return ;;
  esac
  case \$word in
    -*) mapfile -t COMPREPLY < <(compgen -W "$options" -- "\$word") ;;
    *) mapfile -t COMPREPLY < <(for end in xml yaml yml; do compgen -f -X "!*.\$end" -- "\$word"; done; compgen -d -- "\$word") ;;
  esac
}
complete -o filenames -F _strut strut
END
