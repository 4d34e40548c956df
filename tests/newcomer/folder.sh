# What scripts that try a tool share, to be sourced: an empty folder that goes at the end, and `fail TEXT`, which
# shows the file `log` and leaves 1 in $failed.
folder=$(mktemp -d "${TMPDIR:-/tmp}/strut-$(basename "$0" .sh)-XXXXXX")
trap 'rm -rf "$folder"' EXIT
failed=0

fail() {
  echo "FAILED: $1"
  cat "$folder/log"
  failed=1
}
