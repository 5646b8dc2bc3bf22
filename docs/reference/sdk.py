#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes docs/reference/sdk/ from the comments of engine/sdk/vestige/: a page a header, and an index.

    docs/reference/sdk.py            writes the pages
    docs/reference/sdk.py --check    says whether they are up to date; exit code 1 if not

Knows as much of C++ as these headers need, formatted by clang-format: declarations in namespaces,
classes with their members, macros. What it cannot read, and a doc-comment that it would lose, stop it.
Left out are bodies of functions, private members and namespaces called `detail`.
"""
import argparse
import os
import re
import sys
import textwrap

HERE = os.path.dirname(os.path.abspath(__file__))
HOME = os.path.dirname(os.path.dirname(HERE))
HEADERS = os.path.join(HOME, "engine", "sdk", "vestige")
PAGES = os.path.join(HERE, "sdk")
MADE = "<!-- Made by docs/reference/sdk.py from the headers: change those. -->\n"

TOKEN = re.compile(r"""
    (?P<comment>//[^\n]*) | (?P<block>/\*.*?\*/) |
    (?P<macro>^[ \t]*\#(?:[^\n\\]|\\.)*(?:\\\n(?:[^\n\\]|\\.)*)*) |
    (?P<string>"(?:[^"\\]|\\.)*") | (?P<char>(?<![0-9a-fA-F])'(?:[^'\\]|\\.)*') |
    (?P<word>[A-Za-z_]\w*) | (?P<number>\d[\w.']*) | (?P<blank>\s+) | (?P<sign>.)
    """, re.X | re.S | re.M)


class Unreadable(Exception):
    pass


class Token:
    def __init__(self, kind, text, start, end):
        self.kind, self.text, self.start, self.end = kind, text, start, end


class Item:
    """A declaration, a section's title, or a macro."""

    def __init__(self, kind, name, code, doc, line, end_line):
        self.kind, self.name, self.code, self.doc = kind, name, code, doc
        self.line, self.end_line = line, end_line
        self.beside = []  # comments that stand behind the declaration
        self.between = ""  # directives between it and the one before


class Header:
    """Reads one header. `items` in the order of the file; `opening` is what it says of itself."""

    def __init__(self, path):
        self.path = path
        self.name = os.path.relpath(path, HEADERS).replace(os.sep, "/")
        with open(path, encoding="utf-8") as f:
            self.text = f.read()
        self.tokens = [Token(m.lastgroup, m.group(), m.start(), m.end())
                       for m in TOKEN.finditer(self.text) if m.lastgroup != "blank"]
        self.lines = [0] + [m.end() for m in re.finditer("\n", self.text)]
        self.taken = set()  # starts of doc-comments that are shown, or left out on purpose
        self.items = []
        self.opening = []
        self.read_opening()
        self.read_scope(0, len(self.tokens))
        for t in self.tokens:
            if t.kind == "comment" and t.text.startswith("///") and t.start not in self.taken:
                self.fail(t, "this comment would be lost")

    def line(self, at):
        low, high = 0, len(self.lines)
        while high - low > 1:
            middle = (low + high) // 2
            low, high = (middle, high) if self.lines[middle] <= at else (low, middle)
        return low + 1

    def fail(self, token, why):
        raise Unreadable(f"{self.path}:{self.line(token.start)}: {why}")

    def stands_alone(self, token):
        return not self.text[self.lines[self.line(token.start) - 1]:token.start].strip()

    # ---- comments

    def read_opening(self):
        """Comments before the first declaration, blank lines as paragraphs; the licence aside. Doc
        comments count if a namespace follows."""
        group, last = [], None
        for i, t in enumerate(self.tokens):
            if t.kind == "macro":
                continue
            if t.kind != "comment":
                break
            if "SPDX" in t.text:
                continue
            is_doc = t.text.startswith("///")
            if is_doc and not self.before_namespace(i):
                break
            if last is not None and self.line(t.start) > last + 1:
                group.append("")
            last = self.line(t.start)
            group.append(re.sub(r"^///? ?", "", t.text))
            self.taken.add(t.start)
        self.opening = group

    def before_namespace(self, i):
        while self.tokens[i].kind == "comment":
            i += 1
        return self.tokens[i].text == "namespace"

    def doc_before(self, i):
        """The lines of the doc-comment that ends right before token i."""
        first = i
        while first > 0 and self.tokens[first - 1].kind == "comment" and self.stands_alone(
                self.tokens[first - 1]) and self.tokens[first - 1].text.startswith("///"):
            first -= 1
        for t in self.tokens[first:i]:
            self.taken.add(t.start)
        return [re.sub(r"^/// ?", "", t.text) for t in self.tokens[first:i]]

    # ---- declarations

    def matching(self, i):
        """Index of the bracket that closes the one at i."""
        pairs, open_ = {"{": "}", "(": ")", "[": "]"}, []
        for j in range(i, len(self.tokens)):
            t = self.tokens[j]
            if t.kind != "sign":
                continue
            if t.text in pairs:
                open_.append(pairs[t.text])
            elif t.text in pairs.values():
                if open_.pop() != t.text:
                    self.fail(t, "brackets do not match")
                if not open_:
                    return j
        self.fail(self.tokens[i], "never closed")

    def take_all(self, first, last):
        for t in self.tokens[first:last]:
            self.taken.add(t.start)

    def end_of(self, i, last):
        """(index past the declaration at i, index of the body's brace or None)."""
        body = None
        while i < last:
            t = self.tokens[i]
            if t.kind == "macro" or t.kind == "comment":
                i += 1
            elif t.text in "([":
                i = self.matching(i) + 1
            elif t.text == "{":
                # A value in braces, as in `Vec3 low{...}, high` or `= {...}`, is no body.
                before = self.tokens[i - 1]
                close = self.matching(i)
                after = self.tokens[close + 1].text if close + 1 < len(self.tokens) else ""
                is_value = before.text == "=" or (after in (";", ",", ")") and not body)
                is_type = self.is_type(i)
                i = close + 1
                if is_type:
                    body = close  # up to the semicolon
                elif not is_value:
                    return i, self.index_of(t)
            elif t.text == ";":
                return i + 1, None
            else:
                i += 1
        self.fail(self.tokens[last - 1], "a declaration does not end")

    def index_of(self, token):
        return self.tokens.index(token)

    def is_type(self, brace):
        """Whether the brace opens the body of a class, structure or enumeration."""
        for j in range(brace - 1, -1, -1):
            t = self.tokens[j]
            if t.kind == "comment" or t.kind == "macro":
                continue
            if t.text in ("class", "struct", "enum", "union"):
                return j == 0 or self.tokens[j - 1].text not in ("<", ",")
            if t.text in (";", "}", "{", ")", "="):
                return False
        return False

    def read_scope(self, i, last):
        while i < last:
            t = self.tokens[i]
            if t.kind == "comment":
                title = re.match(r"// -{5,} ?(.*)", t.text)
                if title:
                    self.items.append(Item("title", title.group(1), "", [], 0, 0))
                i += 1
            elif t.kind == "macro":
                i = self.read_macro(i)
            elif t.text == "namespace" or (t.text == "extern" and self.tokens[i + 1].kind == "string"
                                           and self.tokens[i + 2].text == "{"):
                brace = next(j for j in range(i, last) if self.tokens[j].text == "{")
                close = self.matching(brace)
                doc, name = self.doc_before(i), self.tokens[brace - 1].text
                if name == "detail":
                    self.take_all(i, close)
                    i = close + 1
                    continue
                if t.text == "namespace" and name != "vestige":
                    self.items.append(Item("title", f"namespace {name}", "", doc, 0, 0))
                first = len(self.items)
                self.read_scope(brace + 1, close)
                if t.text == "namespace" and name != "vestige":
                    for item in self.items[first:]:
                        item.name = f"{name}::{item.name}"
                i = close + 1
            elif t.text in (";", "using") and self.tokens[i + 1].text == "namespace":
                i = self.end_of(i, last)[0]
            elif t.text == ";":
                i += 1
            else:
                i = self.read_declaration(i, last)

    def read_macro(self, i):
        t = self.tokens[i]
        m = re.match(r"\s*#\s*define\s+(\w+)(\([^)]*\))?", t.text)
        doc = self.doc_before(i)
        if m and (doc or m.group(2)) and not m.group(1).endswith("_"):
            self.items.append(Item("macro", m.group(1), f"#define {m.group(1)}{m.group(2) or ''}",
                                   doc, self.line(t.start), self.line(t.end)))
        return i + 1

    def trailing(self, end):
        """A comment ///< behind the declaration that ends before token `end`, and where it ends.
        Its later lines stand alone, but below its first."""
        i, lines = end, []
        column = None
        while i < len(self.tokens) and self.tokens[i].kind == "comment":
            t = self.tokens[i]
            here = t.start - self.lines[self.line(t.start) - 1]
            if not (t.text.startswith("///<") if column is None else
                    t.text.startswith("///<") and here == column):
                break
            if column is None and self.line(t.start) != self.line(self.tokens[end - 1].end):
                break
            column = here
            self.taken.add(t.start)
            lines.append(re.sub(r"^///<? ?", "", t.text))
            i += 1
        return lines, i

    def read_declaration(self, i, last):
        doc = self.doc_before(i)
        end, body = self.end_of(i, last)
        start = self.tokens[i].start
        kind, name = self.name_of(i, body if body is not None else end - 1)
        if kind == "type":
            brace = next((j for j in range(i, end) if self.tokens[j].text == "{"), None)
            if brace is None:
                return end  # announced only
            code = self.members(i, brace, self.matching(brace))
            self.take_all(i, end)
        elif body is not None:
            self.take_all(body, end)  # its own business
            code = self.without_body(i, body)
        else:
            code = self.text[start:self.tokens[end - 1].end]
        more, after = self.trailing(end)
        bare = re.sub(r"^inline (?!namespace)", "", code)
        code = re.sub(rf"\n {{{len(code) - len(bare)}}}(?= )", "\n", bare) if bare != code else code
        last_line = self.line(self.tokens[after - 1].end - 1)
        item = Item(kind, name, code, doc, self.line(start), last_line)
        item.beside = more
        self.items.append(item)
        return after

    def without_body(self, i, body):
        """A function's declaration; a constructor's list of initialisers belongs to its body."""
        j = i
        while j < body:
            t = self.tokens[j]
            if t.text in "([" and t.kind == "sign":
                j = self.matching(j) + 1
                continue
            if t.text == ":" and self.text[t.start - 1:t.end + 1] not in ("::", " ::"):
                beside = (self.tokens[j - 1].text, self.tokens[j + 1].text)
                if ":" not in beside:
                    return self.text[self.tokens[i].start:self.tokens[j - 1].end] + ";"
            j += 1
        return self.text[self.tokens[i].start:self.tokens[body - 1].end] + ";"

    def name_of(self, i, end):
        """What kind of thing tokens i to end declare, and its name."""
        words = [t for t in self.tokens[i:end] if t.kind in ("word", "sign")]
        at = 0
        if words[0].text == "template":  # its parameters
            depth = 0
            for at, t in enumerate(words):
                depth += (t.text == "<") - (t.text == ">")
                if at > 0 and depth == 0:
                    break
            at += 1
        while words[at].text in ("extern", "inline"):
            at += 1
        head = words[at].text
        if head == "using":
            return "alias", words[at + 1].text
        if head == "typedef":
            names = [w.text for w in words]
            until = names.index("__attribute__") if "__attribute__" in names else len(names)
            return "alias", names[until - 1]
        if head in ("class", "struct", "enum", "union"):
            k = at + 1
            while words[k].text in ("class", "struct"):
                k += 1
            return "type", words[k].text
        for k in range(at, len(words)):
            t = words[k].text
            if t == "operator":
                after = self.text[words[k].end:].split("(")[0].strip()
                return "function", "operator" + (after or "()")
            if t == "(" and k > at:
                return "function", words[k - 1].text
            if t in ("=", "{", "["):
                return "constant", words[k - 1].text
        return "constant", words[-1].text

    # ---- classes

    def members(self, i, brace, close):
        """The text of a class without bodies, without what is private."""
        head = self.text[self.tokens[i].start:self.tokens[brace].start].strip()
        plain = re.sub(r"^template\s*<[^{]*?>\s*(?=class|struct)", "", head)
        is_class = plain.startswith("class")
        if plain.startswith("enum"):
            return self.text[self.tokens[i].start:self.tokens[close].end] + ";"
        out, shown, last_end = [], not is_class, self.tokens[brace].end
        j = brace + 1
        while j < close:
            t = self.tokens[j]
            if t.text in ("public", "private", "protected") and self.tokens[j + 1].text == ":":
                shown = t.text != "private"
                if shown and is_class:
                    out.append(f"\n{t.text}:")
                last_end = self.tokens[j + 1].end
                j += 2
                continue
            if t.kind in ("comment", "macro"):
                if shown:
                    out.append(self.text[last_end:t.end])
                last_end = t.end
                j += 1
                continue
            end, body = self.end_of(j, close)
            if shown:
                gap = self.text[last_end:t.start]
                nested = next((k for k in range(j, end) if self.tokens[k].text == "{"
                               and self.is_type(k)), None)
                if nested is not None:
                    code = self.members(j, nested, self.matching(nested))
                elif body is not None:
                    code = self.without_body(j, body)
                else:
                    code = self.text[t.start:self.tokens[end - 1].end]
                out.append(gap + code)
            last_end = self.tokens[end - 1].end
            j = end
        # Labels of access stand half-way out, as in the header.
        inside = textwrap.dedent("".join(out).strip("\n"))
        inside = textwrap.dedent(re.sub(r"(?m)^(public|protected):$", r"", inside)) if not is_class \
            else inside
        lines = [x.strip() and (" " + x if re.match(r"(public|protected):$", x) else x)
                 for x in inside.rstrip().split("\n")]
        indented = "\n".join(lines)
        if not is_class:
            indented = textwrap.indent(textwrap.dedent(indented), "  ")
        return f"{head} {{\n{indented}\n}};" if inside else f"{head} {{}};"


# ---- Markdown

def escaped(text):
    """Text that Markdown shows as it is, spans between backticks aside."""
    parts = re.split(r"(`[^`]*`)", text)
    return "".join(p if p.startswith("`") and p.endswith("`") and len(p) > 1
                   else re.sub(r"([\\`*_\[\]<|~&$]|^[>#+=-])", r"\\\1", p) for p in parts)


def prose(lines, link):
    """A comment as Markdown: paragraphs joined, lists as lists, indented text and tables as code."""
    paragraphs, current = [], []
    for line in lines + [""]:
        if line.strip():
            current.append(line)
        elif current:
            paragraphs.append(current)
            current = []
    out = []
    for p in paragraphs:
        out += blocks(p, link)
    return "\n\n".join(out)


def blocks(lines, link):
    """Splits a paragraph where its kind changes: prose, a list, code."""
    out, text, items, code = [], [], [], []
    columns = [bool(re.search(r"\S {2,}\S", re.sub(r"^(\s*\*) +", r"\1 ", line))) for line in lines]
    columns += [False]
    aligned = [c and (columns[k + 1] or (k > 0 and columns[k - 1]))
               for k, c in enumerate(columns[:-1])]

    def flush():
        if text:
            out.append(link(escaped(" ".join(s.strip() for s in text))))
        if items:
            out.append("\n".join("- " + link(escaped(" ".join(x.strip() for x in i))) for i in items))
        if code:
            out.append("```cpp\n" + textwrap.dedent("\n".join(code)) + "\n```")
        text.clear(), items.clear(), code.clear()

    for k, line in enumerate(lines):
        star = re.match(r"\s*\* +(.*)", line)
        if star:
            if not items:
                flush()
            items.append([star.group(1)])
        elif items:
            items[-1].append(line)
        elif (aligned[k] or re.match(" {4,8}\\S", line) or (code and line.startswith("  "))
              or (line.startswith("  ") and text and text[-1].endswith(":"))):
            if not code:
                flush()
            code.append(line)
        else:
            if not text:
                flush()
            text.append(line)
    flush()
    return out


class Pages:
    def __init__(self, headers):
        self.headers = headers
        self.anchors = {}
        for h in headers:
            used = {}
            for entry in self.entries(h):
                if entry["title"] is None:
                    continue
                slug = re.sub(r"[^\w\- ]", "", entry["title"].lower()).replace(" ", "-")
                count = used.get(slug, 0)
                used[slug] = count + 1
                anchor = f"{slug}-{count}" if count else slug
                entry["anchor"] = anchor
                for item in entry["items"]:
                    if item.kind in ("type", "alias", "macro"):
                        self.anchors.setdefault(item.name, (h.name, anchor))
                        self.anchors[(h.name, item.name)] = (h.name, anchor)

    def entries(self, h):
        """What gets a heading of its own: types and macros one by one; other declarations in the
        groups that blank lines and comments make of them."""
        if hasattr(h, "entries"):
            return h.entries
        h.entries, group = [], None
        for item in h.items:
            if item.kind == "title":
                h.entries.append({"title": item.name, "items": [], "level": 2, "doc": item.doc})
                group = None
                continue
            alone = item.kind in ("type", "macro")
            joins = group and not alone and self.touches(h, group[-1], item)
            if joins:
                group.append(item)
                continue
            group = [item]
            h.entries.append({"title": "", "items": group, "level": 3})
            if alone:
                group = None
        for e in h.entries:
            if e["items"]:
                names = list(dict.fromkeys(i.name for i in e["items"]))
                e["title"] = ", ".join(names[:4]) + (", ..." if len(names) > 4 else "")
        return h.entries

    def touches(self, h, one, next_):
        """Whether no blank line and no other declaration stands between the two."""
        lines = h.text.split("\n")[one.end_line:next_.line - 1]
        if any(not x.strip() for x in lines):
            return False
        directives = [x for x in lines if x.lstrip().startswith("#")]
        next_.between = "\n".join(directives)
        return True

    def page_of(self, name):
        return name.replace("/", "_").replace(".h", ".md")

    def target(self, word, here):
        header, anchor = self.anchors.get((here, word)) or self.anchors[word]
        return f"#{anchor}" if header == here else f"{self.page_of(header)}#{anchor}"

    def linker(self, here, itself=()):
        """Links the names of types where they stand in a text and are no ordinary words."""
        def header(m):
            name = m.group(2).replace("\\", "")
            if name == here or name not in {h.name for h in self.headers}:
                return m.group()
            return f"{m.group(1)}[{m.group(2)}]({self.page_of(name)})"

        def link(text):
            def one(m):
                word = m.group(2)
                if word not in self.anchors or word in itself:
                    return m.group()
                if not (re.search(r"[a-z][A-Z]", word) or "_" in word or m.group(3)):
                    return m.group()
                return f"{m.group(1)}[{word}]({self.target(word, here)}){m.group(3)}"
            text = re.sub(r"(^|[^\w`\[/.])([A-Z]\w+)((?:::)?)(?![\w`/])", one, text)
            return re.sub(r"(^|[^\w`\[/\\])((?:\w|\\_)+(?:/(?:\w|\\_)+)?\.h)\b(?!\])", header, text)
        return link

    def uses(self, code, here, itself):
        plain = re.sub(r"//[^\n]*", "", code)
        found = [w for w in dict.fromkeys(re.findall(r"[A-Za-z_]\w*", plain))
                 if w in self.anchors and w not in itself and w != "Real"]
        if not found:
            return ""
        return "Uses " + ", ".join(f"[{escaped(w)}]({self.target(w, here)})" for w in found) + ".\n\n"

    def source(self, h, line=None):
        path = f"../../../engine/sdk/vestige/{h.name}"
        return f"[{h.name}:{line}]({path}#L{line})" if line else f"[{h.name}]({path})"

    def page(self, h):
        out = [MADE, f"# vestige/{escaped(h.name)}\n\n", f"`#include <vestige/{h.name}>` ",
               f"({self.source(h)})\n\n"]
        opening = prose(h.opening, self.linker(h.name))
        if opening:
            out.append(opening + "\n\n")
        listed = [e for e in self.entries(h) if e["items"]]
        if len(listed) > 4:
            out.append("On this page: " + ", ".join(
                f"[{escaped(e['title'])}](#{e['anchor']})" for e in listed) + ".\n\n")
        for e in self.entries(h):
            out.append(f"{'#' * e['level']} {escaped(e['title'])}\n\n")
            if not e["items"]:
                doc = prose(e["doc"], self.linker(h.name))
                out.append(doc + "\n\n" if doc else "")
                continue
            itself = {i.name for i in e["items"]}
            if len(e["items"]) == 1:
                item = e["items"][0]
                doc, code = prose(item.doc + item.beside, self.linker(h.name, itself)), item.code
                if doc:
                    out.append(doc + "\n\n")
            else:
                code = "\n".join(with_comments(i) for i in e["items"])
                if any(i.between for i in e["items"]):  # halves of an #if
                    lines = h.text.split("\n")
                    code = "\n".join([lines[e["items"][0].line - 2], code,
                                      lines[e["items"][-1].end_line]])
            out.append(f"```cpp\n{code}\n```\n\n")
            out.append(self.uses(code, h.name, itself))
            out.append(self.source(h, e["items"][0].line) + "\n\n")
        return "".join(out).rstrip("\n") + "\n"

    def index(self):
        out = [MADE, "# The SDK, header by header\n\n",
               "What a plugin may include: C++20 and the standard library, nothing else. ",
               "[A plugin of your own](../../plugins/README.md) says how to begin.\n\n",
               "| header | about | types |\n| --- | --- | --- |\n"]
        for h in self.headers:
            about = first_sentence(h)
            types = [i.name for i in h.items if i.kind == "type"]
            shown = ", ".join(f"[{escaped(t)}]({self.page_of(h.name)}{self.target(t, h.name)})"
                              for t in dict.fromkeys(types))
            out.append(f"| [{escaped(h.name)}]({self.page_of(h.name)}) | {escaped(about)} | {shown} |\n")
        return "".join(out)

    def all(self):
        pages = {self.page_of(h.name): self.page(h) for h in self.headers}
        pages["README.md"] = self.index()
        return pages


def with_comments(item):
    """A declaration among others, as the header has it."""
    before = ([item.between] if item.between else []) + [f"/// {x}".rstrip() for x in item.doc]
    gap = "  ///< "
    margin = len(item.code.split("\n")[-1])
    behind = "".join((gap if k == 0 else "\n" + " " * margin + gap) + x
                     for k, x in enumerate(item.beside))
    return "\n".join([*before, item.code + behind])


def first_sentence(h):
    text = ""
    for line in h.opening or next((i.doc for i in h.items if i.doc), []):
        if not line.strip() or line.startswith("  "):
            break
        text += " " + line.strip()
    depth, text = 0, text.strip()
    for k, c in enumerate(text):
        depth += (c in "[(") - (c in "])")
        if depth == 0 and c in ".:" and text[k + 1:k + 2] in ("", " "):
            return text[:k]
    return text


def make():
    paths = sorted(os.path.join(folder, f) for folder, _, files in os.walk(HEADERS)
                   for f in files if f.endswith(".h"))
    return Pages([Header(p) for p in paths]).all()


def stale(pages):
    """Names of pages that are not as they should be."""
    found = set(os.listdir(PAGES)) if os.path.isdir(PAGES) else set()
    wrong = sorted(found ^ set(pages))
    for name in sorted(found & set(pages)):
        with open(os.path.join(PAGES, name), encoding="utf-8") as f:
            if f.read() != pages[name]:
                wrong.append(name)
    return wrong


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("--check", action="store_true", help="write nothing, say what is out of date")
    a = p.parse_args()
    try:
        pages = make()
    except Unreadable as e:
        sys.exit(str(e))
    if a.check:
        wrong = stale(pages)
        if wrong:
            sys.exit("\n".join(f"docs/reference/sdk/{name} is out of date" for name in wrong)
                     + "\nThe headers of the SDK changed. Run: python3 docs/reference/sdk.py")
        return
    os.makedirs(PAGES, exist_ok=True)
    for name in stale(pages):
        path = os.path.join(PAGES, name)
        if name not in pages:
            os.remove(path)
            continue
        with open(path, "w", encoding="utf-8") as f:
            f.write(pages[name])


if __name__ == "__main__":
    main()
