#!/usr/bin/env bash
# Python 3.11.7, csv: a byte order mark before a quoted first heading, as Moodle's worksheets have it, doesn't
# only stick to the heading: the quotes stay in it as well, and a delimiter within them divides the heading in two.
# Seen: ['\ufeff"Name', ' first"', 'ID'] for a heading of two columns.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 - <<'PYTHON'
import csv
import io
import sys

content = b'\xef\xbb\xbf"Name, first","ID"\r\n"Lee, Ann","11"\r\n'
print("Python", sys.version.split()[0])
for encoding in ("utf-8", "utf-8-sig"):
    rows = [*csv.reader(io.StringIO(content.decode(encoding), newline=""))]
    print(encoding, rows)
    assert rows[1] == ["Lee, Ann", "11"]
    heading = ["Name, first", "ID"] if encoding == "utf-8-sig" else ['\ufeff"Name', ' first"', "ID"]
    assert rows[0] == heading, "csv passes over a byte order mark now"
PYTHON
