# Shared by scripts that try a tool; to be sourced. Makes an empty folder that is removed at the end, and defines `fail
# TEXT`, which shows the file `log` and sets $failed to 1.
folder=$(mktemp -d "${TMPDIR:-/tmp}/strut-$(basename "$0" .sh)-XXXXXX")
trap 'rm -rf "$folder"' EXIT
failed=0

fail() {
  echo "FAILED: $1"
  cat "$folder/log"
  failed=1
}
