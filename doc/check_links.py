# SPDX-License-Identifier: GPL-3.0-or-later
#
# Every link and picture of the HTML pages in a folder leads to a file that is there, and to a place
# in it that has this name:
#
#   python3 check_links.py build/doc/html
import sys
import urllib.parse
from html.parser import HTMLParser
from pathlib import Path


class Page(HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.links, self.names = [], set()
        self.feed(path.read_text(errors="replace"))

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("id", "name") and value:
                self.names.add(value)
            if name in ("href", "src") and value:
                self.links.append(value)


def broken_links(folder):
    pages = {path.resolve(): Page(path) for path in sorted(folder.glob("**/*.html"))}
    for path, page in pages.items():
        for link in page.links:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            file = urllib.parse.unquote(parts.path)
            target = (path.parent / file).resolve() if file else path
            anchor = urllib.parse.unquote(parts.fragment)
            if not target.exists():
                yield f"{path.name}: {link}: there is no such file"
            elif anchor and target in pages and anchor not in pages[target].names:
                yield f"{path.name}: {link}: there is no such place in the file"


def main():
    folder = Path(sys.argv[1])
    broken = list(broken_links(folder))
    print("\n".join(broken))
    if not (folder / "index.html").exists():
        sys.exit(f"{folder} has no index.html")
    if broken:
        sys.exit(f"{len(broken)} links lead nowhere")


main()
