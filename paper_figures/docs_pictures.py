"""The pictures of docs/paper-figures.md: the figures' PNG, small in bytes."""
import pathlib

from PIL import Image

FOLDER = pathlib.Path(__file__).resolve().parent.parent / "docs/pictures/figures"
WIDTH, COLOURS = 1000, 256


def write(pictures):
    """Each picture, at most WIDTH pixels wide with COLOURS colours, under its own name. Returns their bytes together."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    total = 0
    for picture in pictures:
        image = Image.open(picture).convert("RGB")
        image.thumbnail((WIDTH, WIDTH), Image.LANCZOS)
        image.quantize(COLOURS, dither=Image.Dither.NONE).save(FOLDER / picture.name, optimize=True)
        total += (FOLDER / picture.name).stat().st_size
    return total
