"""Tests of the documentation: every relative link of a tracked *.md file leads to a file, and README.md stays short."""
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
README_LINES = 150
PICTURE_BYTES = 300 * 1024
LINK = re.compile(r"\]\(([^)\s]+)\)")


def list_files(*patterns):
    # Files that are new but not ignored count too: a link may lead to one before it is committed.
    result = subprocess.run(["git", "-c", "safe.directory=*", "-C", str(ROOT), "ls-files", "--cached", "--others",
                             "--exclude-standard", *patterns], capture_output=True, text=True, check=True)
    return [ROOT / name for name in result.stdout.splitlines() if (ROOT / name).exists()]


def read_prose(page):
    """The page without code, in which brackets mean something else."""
    text = re.sub(r"^```.*?^```", "", page.read_text(), flags=re.M | re.S)
    return re.sub(r"`[^`]*`", "", text)


def find_anchors(page):
    """Anchors as GitHub makes them from headings."""
    headings = re.findall(r"^#+ +(.*)$", page.read_text(), flags=re.M)
    return {re.sub(r"[^\w\- ]", "", h.lower()).replace(" ", "-") for h in headings}


def find_fault(page, link):
    """What is wrong with a link, or None."""
    if re.match(r"[a-z]+:", link):
        return None
    path, _, anchor = link.partition("#")
    target = (page.parent / path).resolve() if path else page
    if not target.exists():
        return "leads nowhere"
    if not target.is_relative_to(ROOT):
        return "leads out of the checkout"
    if anchor and target.exists() and target.suffix == ".md" and anchor not in find_anchors(target):
        return "names a heading that is not there"
    return None


def check_links():
    pages = list_files("*.md")
    assert pages, "no *.md file found"
    for page in pages:
        for link in LINK.findall(read_prose(page)):
            fault = find_fault(page, link)
            if fault:
                yield f"{page.relative_to(ROOT)}: ({link}) {fault}"


def check_sizes():
    lines = len((ROOT / "README.md").read_text().splitlines())
    if lines > README_LINES:
        yield f"README.md has {lines} lines, the limit is {README_LINES}: move some to docs/"
    for picture in list_files("docs/pictures/*"):
        if picture.stat().st_size > PICTURE_BYTES:
            yield f"{picture.relative_to(ROOT)} is over {PICTURE_BYTES // 1024} KiB"


def check_that_faults_are_found():
    page = ROOT / "README.md"
    for link in ("docs/no_such_page.md", "../..", "docs/README.md#no-such-heading"):
        if not find_fault(page, link):
            yield f"this test does not find that ({link}) is wrong"


def main():
    if not (ROOT / ".git").exists():
        print("no git checkout: which files belong to it is not known")
        return 77
    faults = [fault for check in (check_links, check_sizes, check_that_faults_are_found) for fault in check()]
    print("\n".join(faults) or "all passed")
    return 1 if faults else 0


sys.exit(main())
