#!/usr/bin/env bash
# alerts.sh DEPLOY: the alerts ask for figures that the table in README.md has, which are those that kcsd shows
# (OperatePage.NamesEveryFigureThatKcsdShows).
set -euo pipefail
listed=$(grep -oP '^\| `\K(kcs|process)_[a-z_]+' "$1/README.md" | sort -u) ||
  { echo "there is no figure in the tables of deploy/README.md"; exit 1; }
# A histogram comes as three series.
asked=$(grep -v '^ *#' "$1/alerts.yml" | grep -oP '\b(kcs|process)_[a-z_]+' | sed -E 's/_(bucket|sum|count)$//' | sort -u) ||
  { echo "no alert in deploy/alerts.yml asks for a figure of kcsd"; exit 1; }
unknown=$(comm -13 <(echo "$listed") <(echo "$asked"))
if [[ -n $unknown ]]; then
  echo "deploy/alerts.yml asks for what is not among the figures in deploy/README.md:" $unknown
  exit 1
fi
