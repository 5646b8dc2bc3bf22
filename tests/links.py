#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every link from one page of the documentation to another arrives: file, heading, line.

    tests/links.py            the pages of this checkout
    tests/links.py FOLDER     every page below FOLDER: an installation
"""
import os
import re
import sys

HOME = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def text_of(path):
    with open(path, encoding="utf-8") as f:
        return f.read()


def without_code(text):
    text = re.sub(r"(?ms)^```.*?^```", "", text)
    text = re.sub(r"(?m)^(?: {4}|\t).*$", "", text)
    return re.sub(r"(`+)(?!`).*?(?<!`)\1(?!`)", "", text)


def anchors(text):
    """As GitHub makes them of headings: lower case, blanks to hyphens, most other signs dropped."""
    found, used = set(), {}
    for title in re.findall(r"(?m)^#{1,6} +(.*)$", re.sub(r"(?ms)^```.*?^```", "", text)):
        slug = re.sub(r"[^\w\- ]", "", title.strip().lower()).replace(" ", "-")
        count = used.get(slug, 0)
        used[slug] = count + 1
        found.add(f"{slug}-{count}" if count else slug)
    return found


def problem(page, link):
    path, _, anchor = link.partition("#")
    target = os.path.normpath(os.path.join(os.path.dirname(page), path)) if path else page
    if not os.path.exists(target):
        return "there is no such file"
    line = re.fullmatch(r"L(\d+)", anchor)
    if line:
        return None if int(line.group(1)) <= text_of(target).count("\n") else "there is no such line"
    if anchor and anchor not in anchors(text_of(target)):
        return "there is no such heading"
    return None


def pages_below(home):
    """All but those of build folders and hidden ones."""
    for folder, below, files in os.walk(home):
        below[:] = [b for b in below if not b.startswith((".", "build"))]
        yield from (os.path.join(folder, f) for f in files if f.endswith(".md"))


def main(home):
    pages = list(pages_below(home))
    if not pages:
        sys.exit(f"there is no page below {home}")
    wrong = []
    for page in sorted(pages):
        for link in re.findall(r"(?<!\\)\]\(([^)\s]+)\)", without_code(text_of(page))):
            why = None if re.match(r"\w+:", link) else problem(page, link)
            if why:
                wrong.append(f"{os.path.relpath(page, home)}: {link}: {why}")
    if wrong:
        sys.exit("\n".join(wrong))


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else HOME)
