"""Results as files: one JSON a run, named by the hash of everything that decides it, with a checksum of its own."""
import hashlib
import json
import os
import pathlib
import sys


def canonical(value):
    return json.dumps(value, sort_keys=True, separators=(",", ":"), ensure_ascii=True)


def digest(value):
    return hashlib.sha256(canonical(value).encode()).hexdigest()


def file_digest(path):
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


class Damaged(Exception):
    """A result that is not what a run wrote."""


def write_atomically(path, text):
    """Under its name there is the whole file or none, whenever the writer is killed."""
    path.parent.mkdir(parents=True, exist_ok=True)
    draft = path.with_name(f".{path.name}.{os.getpid()}")
    with open(draft, "w") as file:
        file.write(text)
        file.flush()
        os.fsync(file.fileno())
    draft.replace(path)


class Store:
    """`spec` decides a result: model's bytes, placement, settings, seed, program's bytes. Its hash is the file's name.

    The checksum covers spec and result: whoever changes a number by hand, cuts a file or puts it under another name is found
    out. (It is no signature: a forger who computes it anew is not.)
    """

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)

    def path(self, spec):
        return self.folder / f"{digest(spec)}.json"

    def read(self, path):
        try:
            stored = json.loads(path.read_text())
            spec, result, checksum = stored["spec"], stored["result"], stored["checksum"]
        except (ValueError, KeyError, TypeError) as error:
            raise Damaged(f"{path}: cut or no result ({error})") from None
        if checksum != digest({"spec": spec, "result": result}):
            raise Damaged(f"{path}: changed after it was written")
        if path.stem != digest(spec):
            raise Damaged(f"{path}: belongs under another name")
        return spec, result

    def load(self, spec):
        """The stored result or None. A damaged file is said, set aside as *.damaged, and counts as none."""
        path = self.path(spec)
        if not path.exists():
            return None
        try:
            return self.read(path)[1]
        except Damaged as damage:
            print(f"{damage}; set aside, the run is made again", file=sys.stderr)
            path.replace(path.with_suffix(".damaged"))
            return None

    def save(self, spec, result):
        stored = {"spec": spec, "result": result, "checksum": digest({"spec": spec, "result": result})}
        write_atomically(self.path(spec), json.dumps(stored, indent=1) + "\n")

    def check(self):
        """Every damaged file."""
        bad = []
        for path in sorted(self.folder.glob("*.json")):
            try:
                self.read(path)
            except Damaged as damage:
                bad.append(str(damage))
        return bad
