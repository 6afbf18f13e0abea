#!/bin/sh
# Commands of a bundled program, in an empty folder: commands.sh .../evenbreak
set -eu
program=$1
cd "$(mktemp -d)"
"$program" --version
"$program" odds 612 521 --race 7:5
"$program" demo . > demo.txt
"$program" rate demo_league.csv > ratings.csv
"$program" report demo_league.csv --out sheet --page > report.txt
test -s sheet/sheet.pdf
"$program" tournament odds demo_entrants.csv --race 5 > odds.txt
"$program" tournament odds demo_entrants.csv --race 5 --format swiss --rounds 4 > swiss.txt
"$program" publish demo_league.csv --out site > site.txt
"$program" simulate demo_roster.csv --weeks 5 --replicas 8 --jobs 2 > season.txt
"$program" report demo_league.csv --out book --excel > report.txt
"$program" matchups book/sheet.xlsx > again.txt
"$program" lineup --help > help.txt
echo "The commands ran as they should."
