"""The library of instances: the files are those that the generator makes, and go by short names."""

import hashlib

import pytest

from mamttsp import Agents, InputError, Instance, generate, load, paper_instance
from mamttsp.generate import GENERATOR_VERSION
from mamttsp.library import FOLDER, make, parameters, read_manifest

NAMES = list(parameters())
SAMPLE = [NAMES[0], *(name for name in NAMES if "-i01-" in name and name.split("-w")[1] in ("40", "75"))]


def assert_made(name, folder):
    """Make the instance again from the manifest's own arguments; its bytes must be those of the file."""
    arguments = read_manifest()["arguments"][f"{name}.json"]
    make(arguments).write(folder / "again.json")
    assert (folder / "again.json").read_bytes() == (FOLDER / f"{name}.json").read_bytes(), name


@pytest.mark.parametrize("name", SAMPLE)
def test_the_generator_still_makes_the_files_byte_for_byte(name, tmp_path):
    assert_made(name, tmp_path)


@pytest.mark.slow
def test_the_generator_still_makes_every_file_byte_for_byte(tmp_path):
    for name in NAMES:
        assert_made(name, tmp_path)


def test_the_manifest_has_every_file_its_sum_and_its_arguments():
    manifest, files = read_manifest(), {path.name for path in FOLDER.glob("*-w*.json")}
    assert manifest["generator"] == GENERATOR_VERSION
    assert set(manifest["files"]) == set(manifest["arguments"]) == files == {f"{name}.json" for name in NAMES}
    assert manifest["arguments"] == {f"{name}.json": arguments for name, arguments in parameters().items()}
    sums = {name: hashlib.sha256((FOLDER / name).read_bytes()).hexdigest() for name in files}
    assert sums == manifest["files"]


def test_every_file_is_an_instance_of_its_name():
    for name in NAMES:
        instance = load(name)
        n, window = int(name.split("-i")[0].split("n")[-1]), int(name.split("-w")[1])
        assert instance.n_targets == n
        assert all(sum(b - a for a, b in target.windows) == pytest.approx(window) for target in instance.targets)


def test_the_paper_s_instances_are_there():
    assert sum(name.startswith("n") for name in NAMES) == 240
    assert load("n20-i03-w40", n_agents=3) == load("n20-i03-w40-m3") == paper_instance(20, 3, 40, 3)
    assert load("n5-i0-w20") == load("n05-i00-w20") == generate(5, 20, seed=0)


@pytest.mark.parametrize("index", range(10))
def test_the_series_beyond_the_paper(index):
    two = load(f"types-n20-i{index:02}-w40")
    assert len({tuple(entry.depot) for entry in two.agents}) == len({entry.max_speed for entry in two.agents}) == 2
    for n in (20, 25):
        (entry,) = load(f"loads-n{n}-i{index:02}-w40").agents
        needed = sum(target.demand for target in load(f"loads-n{n}-i{index:02}-w40").targets)
        assert 2 * entry.capacity < needed <= 3 * entry.capacity and entry == Agents(
            4, (0, 0), 4.0, capacity=entry.capacity
        )


@pytest.mark.parametrize(
    "name, arguments, message",
    [
        ("n20-i03", {}, 'name: .* is not in the library; names are like "n20-i03-w40"'),
        ("n20-i20-w40", {}, "name: 'n20-i20-w40' is not in the library"),
        ("../n20-i03-w40", {}, "name: "),
        (7, {}, "name: expected str, found int 7"),
        ("n20-i03-w40-m2", {"n_agents": 3}, "n_agents: 'n20-i03-w40-m2' says it already"),
        ("n20-i03-w40-m0", {}, "n_agents: expected a whole number of at least 1, found 0"),
        ("types-n20-i03-w40", {"n_agents": 3}, "n_agents: there are 2 types"),
        ("n20-i03-w40", {"folder": "nowhere"}, "nowhere/n20-i03-w40.json: cannot be read"),
    ],
)
def test_a_name_that_is_not_there_is_one_line(name, arguments, message):
    with pytest.raises(InputError, match=f"^{message}") as caught:
        load(name, **arguments)
    assert len(str(caught.value).splitlines()) == 1


def test_a_manifest_that_cannot_be_read_is_one_line(tmp_path):
    with pytest.raises(InputError, match="manifest.json: cannot be read"):
        read_manifest(tmp_path)


def test_the_files_are_of_the_format_and_the_version_that_suffices():
    versions = {name: Instance.read(FOLDER / f"{name}.json").to_dict()["version"] for name in NAMES}
    assert {name for name, version in versions.items() if version == 2} == {
        name for name in NAMES if name.startswith(("types", "loads"))
    }
