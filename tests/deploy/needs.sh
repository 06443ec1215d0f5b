# Sourced. Ends a test as skipped where what it needs is not installed, and says what is missing.
PATH=$PATH:/usr/sbin

# needs_program PROGRAM DEBIAN_PACKAGE
needs_program() {
  command -v "$1" >/dev/null && return
  echo "skipped: there is no $1 (Debian: $2)"
  exit 77
}

# needs_module PYTHON MODULE DEBIAN_PACKAGE
needs_module() {
  "$1" -c "import $2" 2>/dev/null && return
  echo "skipped: $1 has no module $2 (Debian: $3)"
  exit 77
}
