"""A film as pictures and as a page with a player, and the files it is saved in."""

import dataclasses
import io
import shutil
import subprocess
from typing import ClassVar

from PIL import Image

from ..validation import InputError, file_path

#: pictures a second
PER_SECOND = 8


@dataclasses.dataclass(frozen=True)
class Film:
    """A film: a notebook shows it with a player, and `save` writes it to a file.

    html: a page with the player, which needs no network; frames: its pictures as PNG, in bytes.
    """

    SUFFIXES: ClassVar = (".gif", ".mp4", ".html")

    html: str = dataclasses.field(repr=False)
    frames: tuple = dataclasses.field(repr=False)

    def _repr_html_(self):
        return self.html

    def save(self, path):
        """Write the film to `path`: .gif, .mp4 (where the program ffmpeg is installed) or .html, the page.

        InputError: another suffix, no ffmpeg, or a file that cannot be written.

        >>> import mamttsp
        >>> instance = mamttsp.generate(n_targets=3, total_window=20, seed=1)
        >>> mamttsp.figures.film(instance, mamttsp.solve(instance), step=50).save("tours.avi")
        Traceback (most recent call last):
            ...
        mamttsp.validation.InputError: tours.avi: a film is saved as .gif, .mp4 or .html
        """
        path = file_path("path", path)
        writers = dict(zip(self.SUFFIXES, (self._write_gif, self._write_mp4, self._write_html)))
        if path.suffix.lower() not in writers:
            raise InputError(f"{path}: a film is saved as .gif, .mp4 or .html")
        try:
            writers[path.suffix.lower()](path)
        except OSError as error:
            raise InputError(f"{path}: cannot be written: {error.strerror}") from error

    def _write_gif(self, path):
        first, *others = (few_colours(Image.open(io.BytesIO(frame))) for frame in self.frames)
        # The last picture, with everybody home, stands for two seconds.
        durations = [1000 // PER_SECOND] * len(others) + [2000]
        first.save(path, "gif", save_all=True, append_images=others, duration=durations, loop=0)

    def _write_mp4(self, path):
        if shutil.which("ffmpeg") is None:
            raise InputError(f"{path}: .mp4 needs the program ffmpeg, which is not installed; .gif needs nothing")
        # Even numbers of pixels, and colours that every player knows.
        pixels = ["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p"]
        frames = ["-f", "image2pipe", "-framerate", str(PER_SECOND), "-i", "-"]
        command = ["ffmpeg", "-loglevel", "error", "-y", *frames, *pixels, str(path)]
        ran = subprocess.run(command, input=b"".join(self.frames), capture_output=True)
        if ran.returncode:
            raise InputError(f"{path}: ffmpeg failed: {' '.join(ran.stderr.decode(errors='replace').split())}")

    def _write_html(self, path):
        path.write_text(self.html, encoding="utf-8")


def few_colours(picture):
    """Return an Image with 64 colours instead of millions."""
    return picture.convert("RGB").quantize(64, dither=Image.Dither.NONE)
