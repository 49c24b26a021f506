"""compare_reports_test.py TARN: the JUnit XML and the page of `tarn compare`, read by parsers that are not Tarn's."""
import html.parser
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import urllib.parse
import xml.etree.ElementTree
import zlib

# Names that would be markup, attributes' ends or no text at all. The last one is not UTF-8.
SAME = b"same & <b>'\"same.png"
BRIGHT = b"sub/<script>alert(1)</script> & \"x\".png"
MISSING = b"line\nbreak\x01 ]]> &amp;.png"
EXTRA = b"caf\xc3\xa9 %41 #1?.png"
BAD_BYTES = b"not utf-8 \xff\xc0\xaf \xe0\x80\xaf \xed\xa0\x80.png"
FAILED = {BRIGHT: "failed", MISSING: "missing", EXTRA: "extra", BAD_BYTES: "failed"}
VOID_TAGS = {"meta", "img", "br"}


def readable(name):
    """The name as a report has it: what is not text in XML is U+FFFD."""
    return name.decode(errors="replace").replace("\x01", "\ufffd")


def write_png(path, level):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = (b"\0" + bytes([level, level, 90]) * 24) * 24
    header = struct.pack(">IIBBBBB", 24, 24, 8, 2, 0, 0, 0)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) +
                   chunk(b"IEND", b""))


def make_folders(root):
    for name in (SAME, BRIGHT, MISSING, BAD_BYTES):
        write_png(root + b"/goldens/" + name, 100)
    for name, level in ((SAME, 100), (BRIGHT, 180), (EXTRA, 100), (BAD_BYTES, 180)):
        write_png(root + b"/actual/" + name, level)


class Page(html.parser.HTMLParser):
    """What a page refers to, its text, and tags that are not closed."""

    def __init__(self, text):
        super().__init__()
        self.links, self.tags, self.open, self.faults, self.text = [], set(), [], [], ""
        self.feed(text)
        self.close()
        self.faults += self.open

    def handle_starttag(self, tag, attributes):
        self.tags.add(tag)
        self.links += [value for name, value in attributes if name in ("src", "href")]
        if tag not in VOID_TAGS:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.faults.append(tag)

    def handle_data(self, data):
        self.text += data


def check_junit(file):
    root = xml.etree.ElementTree.parse(file).getroot()
    assert root.tag == "testsuites" and len(root) == 1 and root[0].tag == "testsuite", root.tag
    for element in (root, root[0]):
        counts = [element.get(key) for key in ("tests", "failures", "errors", "skipped")]
        assert counts == ["5", "4", "0", "0"], counts
        assert float(element.get("time")) > 0
    cases = root[0].findall("testcase")
    assert len(cases) == 5
    verdicts = {case.get("name"): case.find("failure") for case in cases}
    assert verdicts.pop(readable(SAME)) is None
    assert set(verdicts) == {readable(name) for name in FAILED}, verdicts
    for name, verdict in FAILED.items():
        failure = verdicts[readable(name)]
        assert failure.get("type") == verdict and failure.get("message").startswith(verdict + ": "), failure.attrib
    assert "flip is " in verdicts[readable(BRIGHT)].get("message")
    assert "\nflip_tile " in verdicts[readable(BRIGHT)].text
    assert all(case.get("classname") and float(case.get("time")) >= 0 for case in cases)


def check_page(folder):
    page = Page((folder / "index.html").read_text(encoding="utf-8"))
    assert not page.faults, page.faults
    assert not page.tags & {"script", "b", "link"}, page.tags
    for name in (SAME, *FAILED):
        assert readable(name) in page.text, (name, page.text)
    assert "4 of 5 pictures did not pass" in page.text and "1 passed" in page.text
    assert "http" not in "".join(page.links) and "url(" not in page.text
    # Pictures of those that failed: two of three, one of a missing one and one of an extra one; shown and linked.
    pictures = {os.fsencode(folder) + b"/" + urllib.parse.unquote_to_bytes(link) for link in page.links}
    written = {os.fsencode(file) for file in folder.rglob("*.png")}
    assert pictures == written and len(written) == 8 and len(page.links) == 16, (pictures, written)


def main():
    tarn = sys.argv[1]
    with tempfile.TemporaryDirectory() as root:
        make_folders(os.fsencode(root))
        run = subprocess.run([tarn, "compare", f"{root}/goldens", f"{root}/actual", "--junit", f"{root}/junit.xml",
                              "--html", f"{root}/made/page", "--json", f"{root}/out.json"], capture_output=True)
        assert run.returncode == 3, (run.returncode, run.stdout, run.stderr)
        check_junit(f"{root}/junit.xml")
        check_page(pathlib.Path(root, "made/page"))
        # A second run into the same places that passes leaves nothing of the first one in its reports.
        subprocess.run(["cp", "-r", f"{root}/goldens", f"{root}/same"], check=True)
        run = subprocess.run([tarn, "compare", f"{root}/goldens", f"{root}/same", "--junit", f"{root}/junit.xml",
                              "--html", f"{root}/made/page"], capture_output=True)
        assert run.returncode == 0, run.stderr
        assert xml.etree.ElementTree.parse(f"{root}/junit.xml").getroot().get("failures") == "0"
        page = Page(pathlib.Path(root, "made/page/index.html").read_text(encoding="utf-8"))
        assert "All pictures passed" in page.text and not page.links, page.links
    print("all passed")


main()
