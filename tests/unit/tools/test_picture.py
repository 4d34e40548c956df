#!/usr/bin/python3
"""tools/picture, run as a user runs it, on small results that are written here: is what is seen where it should be, in the
color that the scale gives to its value?"""
import contextlib
import io
import os
import subprocess
import sys
import unittest
import unittest.mock
import xml.etree.ElementTree as tree

from tool_test import TOOLS, InFolder

import matplotlib.image
import netCDF4
import numpy as np

try:
    from picture_parts import history, painter, rigid, surface, view
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)
from decks import section
from picture_parts.result import Result, clock_of, title
from PIL import Image
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from vtkmodules.vtkFiltersCore import vtkMassProperties, vtkTriangleFilter

H = 1e-3  # m, the spacing


def box(nx, ny, nz, origin=(0, 0, 0)):
    """Centers of cubes."""
    return (np.stack(np.meshgrid(range(nx), range(ny), range(nz), indexing="ij"), -1).reshape(-1, 3) + 0.5) * H + origin


def write_result(path, blocks, displacement, elemental, times=(0, 1e-3), names="XYZ"):
    """blocks: name -> places; displacement and each of elemental: frames x points (x 3), in the order of the blocks."""
    file = netCDF4.Dataset(path, "w", format="NETCDF3_64BIT_OFFSET")
    places = np.concatenate(list(blocks.values()))
    sizes = {"time_step": None, "num_nodes": len(places), "num_el_blk": len(blocks), "len_name": 64, "one": 1,
             "num_att": 2, "num_nod_var": 3, "num_elem_var": len(elemental)}
    for name, size in sizes.items():
        file.createDimension(name, size)

    def text(name, dimension, words):
        file.createVariable(name, "S1", (dimension, "len_name"))[:] = np.array([list(w.ljust(64, "\0")) for w in words], "S1")

    file.createVariable("time_whole", "f8", ("time_step",))[:] = times
    text("eb_names", "num_el_blk", blocks)
    text("name_nod_var", "num_nod_var", ["Displacement" + c for c in names])
    text("name_elem_var", "num_elem_var", elemental)
    for i, c in enumerate("xyz"):
        file.createVariable("coord" + c, "f8", ("num_nodes",))[:] = places[:, i]
        file.createVariable(f"vals_nod_var{i + 1}", "f8", ("time_step", "num_nodes"))[:] = displacement[..., i]
    start = 0
    for b, block in enumerate(blocks.values(), 1):
        here, start = np.arange(start, start + len(block)), start + len(block)
        file.createDimension(f"in{b}", len(block))
        file.createVariable(f"connect{b}", "i4", (f"in{b}", "one"))[:] = here[:, None] + 1
        file.createVariable(f"attrib{b}", "f8", (f"in{b}", "num_att"))[:] = [(0.62 * H, H**3)] * len(block)
        for v, value in enumerate(elemental.values(), 1):
            file.createVariable(f"vals_elem_var{v}eb{b}", "f8", ("time_step", f"in{b}"))[:] = value[:, here]
    file.close()


def hue(color):
    """The part of a color that light, which only multiplies, does not change."""
    color = np.asarray(color, float)[:3]
    return color / np.linalg.norm(color)


def pixel(camera, place):
    """The pixel (column, row) at which a place is seen."""
    right, up, _ = (camera.seen(np.asarray(place)) - camera.middle) / camera.pixel
    return 0.5 * camera.width + right, 0.5 * camera.height - up


class Pictures(InFolder):
    def picture(self, *words):
        return self.run_tool("picture", *words)

    def made(self, *words):
        done = self.picture(*words)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr, "")

    def error(self, *words):
        """One line, and no trace of Python."""
        done = self.picture(*words)
        self.assertNotEqual(done.returncode, 0)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        return done.stderr

    def image(self, name):
        return matplotlib.image.imread(self.folder / name)[..., :3]

    def bar(self, name="bar.e"):
        """16 x 4 x 8 cubes; strain and stress differ between the quarters of the face; its right half moves up by 6 H."""
        places = box(16, 4, 8)
        right, upper = places[:, 0] > 8 * H, places[:, 2] > 4 * H
        after = np.zeros((len(places), 3))
        after[:, 2] = 6 * H * np.clip((places[:, 0] - 6 * H) / (4 * H), 0, 1)
        strain = np.where(upper, np.where(right, 1.0, 0.6), np.where(right, 0.3, 0.0))
        stress = np.where(upper, np.where(right, 2e7, 0.0), np.where(right, 1e8, 6e7))
        both = [np.stack([0 * v, v]) for v in (strain, stress)]
        write_result(self.folder / name, {"bar": places}, np.stack([0 * after, after]),
                     {"Equivalent_Plastic_Strain": both[0], "Von_Mises_Stress": both[1]})
        return places, after, dict(zip(("Equivalent_Plastic_Strain", "Von_Mises_Stress"), both))

    def test_a_result_that_is_cut_off_is_no_picture_of_zeros(self):
        self.bar()
        whole = (self.folder / "bar.e").read_bytes()
        for part in (5, 50, 95, 99.9):
            (self.folder / "cut.e").write_bytes(whole[:int(len(whole) * part / 100)])
            self.assertRegex(self.error("cut.e", "cut.png"), "cut.e is damaged: (its header|it) is cut off")
            self.assertRegex(self.error("--cut", "cut.e", "cut.png"), "cut.e is damaged: (its header|it) is cut off")
        # Filled up with zeros, as by a copy that broke off: the last frame is at t = 0 as is the first.
        (self.folder / "cut.e").write_bytes(whole[:len(whole) // 2].ljust(len(whole), b"\0"))
        self.assertIn("cut.e is damaged: frame 2 of 2 is at t = 0 s, the one before at 0 s", self.error("cut.e", "cut.png"))
        self.assertFalse((self.folder / "cut.png").exists())

    def test_a_history_that_is_cut_off_is_told_as_such(self):
        lines = ["# units: s, J, J, 1", "Time,Kinetic_Energy,External_Work,Balance_Error", "0,1,0,0", "1,2,1,0.5"]
        for cut, said in (("\n".join(lines)[:-6], "h.csv is cut off in line 4, '1,2"), ("\n".join(lines)[:-1], "cut off in line 4"),
                          ("\n".join([*lines[:3], "1,2", "2,3,1,0", ""]), "h.csv is damaged: line 4 has 2 values, expected 4")):
            (self.folder / "h.csv").write_text(cut)
            self.assertIn(said, self.error("h.csv", "h.png"))

    def test_what_is_read_is_never_written(self):
        self.bar()
        (self.folder / "h.csv").write_text("Time,Kinetic_Energy,Balance_Error\n0,1,0\n1,2,0\n")
        for name in ("bar.e", "h.csv"):
            before = (self.folder / name).read_bytes()
            (self.folder / "out.png").unlink(missing_ok=True)
            (self.folder / "out.png").symlink_to(name)
            self.assertIn(f"out.png is {name}, which is read", self.error(name, "out.png"))
            self.assertEqual((self.folder / name).read_bytes(), before)
        (self.folder / "pictures").mkdir()
        (self.folder / "pictures/h-energies.png").symlink_to("../bar.e")  # a name of ours: made anew, not written through
        before = (self.folder / "bar.e").read_bytes()
        self.made("h.csv", "pictures/")
        self.assertEqual((self.folder / "bar.e").read_bytes(), before)
        self.assertGreater((self.folder / "pictures/h-energies.png").stat().st_size, 5000)
        self.made("h.csv", "pictures/")  # once more, over its own

    def test_a_full_disk_leaves_an_earlier_picture(self):
        (self.folder / "h.csv").write_text("Time,Kinetic_Energy,Balance_Error\n0,1,0\n1,2,0\n")
        self.made("h.csv", "h.png")
        before = (self.folder / "h.png").read_bytes()
        small = f"ulimit -f 4; exec '{TOOLS / 'picture'}' h.csv h.png"  # kB
        done = subprocess.run(["bash", "-c", small], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (1, "tools/picture: h.png cannot be written: File too large\n"))
        self.assertEqual((self.folder / "h.png").read_bytes(), before)
        self.assertEqual(sorted(os.listdir(self.folder)), ["h.csv", "h.png"])

    def test_a_folder_keeps_a_picture_that_somebody_else_has_made(self):
        (self.folder / "h.csv").write_text("Time,Kinetic_Energy,Balance_Error\n0,1,0\n1,2,0\n")
        (self.folder / "pictures").mkdir()
        theirs = self.folder / "pictures/h-energies.png"
        theirs.write_bytes(b"\x89PNG\r\n\x1a\n a photograph")
        self.assertIn("h-energies.png is there and was not written by this tool", self.error("h.csv", "pictures/"))
        self.assertEqual(theirs.read_bytes(), b"\x89PNG\r\n\x1a\n a photograph")

    def scene(self, name, **wanted):
        return view.Scene(Result(str(self.folder / name)), view.Wanted(**wanted))

    def test_a_known_point_has_the_color_of_its_value_where_it_moved_to(self):
        places, after, values = self.bar()
        scene = self.scene("bar.e", view=(0, -1, 0))
        images = scene.images(range(2))
        for (row, column), image in images.items():
            value = list(values.values())[row][column]
            for x, z in ((2, 1), (2, 6), (13, 1), (13, 6)):
                point = np.flatnonzero(np.all(np.abs(places - (np.array([x, 0, z]) + 0.5) * H) < 0.1 * H, axis=1))[0]
                right, down = pixel(scene.camera, places[point] + column * after[point])
                found = image[int(down), int(right)]
                # The scale has 256 colors: 0.01. Other quarters' colors are 0.2 and more away.
                expected = hue(view.SCALE(value[point] / np.max(list(values.values())[row])))
                np.testing.assert_allclose(hue(found), expected, atol=0.01, err_msg=f"{row} {column} {x} {z}")
                self.assertGreater(found[:3].max(), 0.3)  # lit
        # Where the right half was before, at its lower edge, there is nothing left.
        right, down = pixel(scene.camera, places[0] + [13 * H, 0, 0])
        self.assertEqual(images[0, 1][int(down), int(right), 3], 0)

    def test_the_picture_shows_the_body(self):
        self.bar()
        self.made("bar.e", "bar.png", "--variable", "Von_Mises_Stress", "--frames", 2)
        self.assertLess(self.image("bar.png").mean(), 0.97)

    def test_a_movie_has_a_picture_of_each_frame(self):
        places = box(4, 4, 4)
        still, times = np.zeros((5, 64, 3)), np.linspace(0, 1e-3, 5)
        still[:, :, 2] = 3 * H * np.linspace(0, 1, 5)[:, None]
        write_result(self.folder / "up.e", {"body": places}, still, {"S": np.ones((5, 64))}, times)
        self.made("--movie", "up.e", "up.gif", "--variable", "S")
        with Image.open(self.folder / "up.gif") as movie:
            self.assertEqual(movie.n_frames, 5)
            pictures = []
            for frame in range(5):
                movie.seek(frame)
                pictures.append(np.asarray(movie.convert("L"), float))
        rows = [np.flatnonzero((p[80:-80, :300] < 200).any(axis=1)).min() for p in pictures]
        self.assertTrue((np.diff(rows) < 0).all(), rows)  # it goes up
        self.assertIn("ends in .gif or .webp", self.error("--movie", "up.e", "up.png"))

    def test_a_folder_gets_a_picture_per_variable_and_the_plots_of_the_history(self):
        self.bar()
        (self.folder / "bar.csv").write_text("# strut; units: s,J,J,1,m,N\n"
                                             "Time,Kinetic_Energy,Plastic_Work,Balance_Error,Max_Displacement,Reaction_Z(wall)\n"
                                             "0,1,0,0,0,0\n1e-3,0.5,0.5,1e-6,6e-3,7\n")
        self.made("bar.e", "bar.csv", "out/")
        self.assertEqual(sorted(os.listdir(self.folder / "out")),
                         ["bar-Equivalent_Plastic_Strain.png", "bar-Von_Mises_Stress.png", "bar-energies.png",
                          "bar-extremes.png", "bar-reactions.png"])
        for name in os.listdir(self.folder / "out"):
            self.assertGreater(self.image(f"out/{name}").std(), 0.02, name)

    def test_the_cut_of_a_bar_and_histories_are_drawn(self):
        self.bar()
        (self.folder / "a.csv").write_text("Time,Kinetic_Energy,Balance_Error\n0,1,0\n1e-3,0.5,1e-6\n")
        self.made("--cut", "bar.e", "cut.png")
        self.made("a.csv", "energies.png")
        self.made("--history", "a.csv", "a.csv", "both.pdf", "--column", "Kinetic_Energy")
        self.made("a.csv", "two.png", "--column", "Kinetic_Energy", "--column", "Balance_Error")
        one, two = (self.drawn_columns(*names) for names in (["Kinetic_Energy"], ["Kinetic_Energy", "Balance_Error"]))
        self.assertEqual((one, two), (1, 2))
        self.assertGreater(self.image("two.png").std(), 0.02)
        self.assertGreater(self.image("cut.png").std(), 0.02)
        self.assertGreater(self.image("energies.png").std(), 0.02)

    def drawn_columns(self, *names):
        """How many panels a picture of these columns has."""
        with unittest.mock.patch.object(history, "finished", lambda figure, panels, clock, out: len(panels)):
            return history.columns([str(self.folder / "a.csv")], names, "out.png")

    def test_columns_have_their_units(self):
        self.assertEqual([title(name) for name in ("Crack_Work", "Sum_Crack_Work(b)", "Plastic_Work", "Von_Mises_Stress", "Reaction_Z(top)", "Damage")],
                         ["Crack Work, J/m3", "Sum Crack Work(b), J/m3", "Plastic Work, J", "Von Mises Stress, Pa", "Reaction Z(top), N", "Damage"])

    def test_times_have_the_unit_of_their_size(self):
        # Slow loading has times of a second and more, which are no milliseconds.
        for longest, expected in ((1.0, (1, "s")), (50.0, (1, "s")), (2e-3, (1e3, "ms")), (6e-6, (1e6, "µs"))):
            self.assertEqual(clock_of(longest), expected)

    def test_a_block_without_strain_is_grey_glass_and_not_in_the_scale(self):
        foam, plate = box(6, 6, 6), box(6, 6, 2, (0, 0, 6 * H))
        strain = np.concatenate([np.full(len(foam), 0.5), np.zeros(len(plate))])
        stress = np.concatenate([np.full(len(foam), 1e8), np.full(len(plate), 9e8)])
        still = np.zeros((2, len(strain), 3))
        write_result(self.folder / "foam.e", {"foam": foam, "plate": plate}, still,
                     {"Equivalent_Plastic_Strain": np.stack([0 * strain, strain]), "Von_Mises_Stress": np.stack([stress] * 2)})
        front = {"view": (0, -1, 0), "frames": 1}
        with contextlib.redirect_stdout(io.StringIO()) as said:
            scene = self.scene("foam.e", **front)
        self.assertIn("block 'plate' is grey glass for all variables, as Equivalent_Plastic_Strain stays 0 in it", said.getvalue())
        self.assertEqual([row.high for row in scene.rows], [0.5, 1e8])
        right, down = (int(p) for p in pixel(scene.camera, [3 * H, 0, 7 * H]))
        found = scene.images([0])[1, 0][down, right]
        self.assertLess(found[3], 0.5)  # nothing behind, so that it is seen through
        np.testing.assert_allclose(hue(found), hue(view.GREY), atol=1e-6)
        solid = self.scene("foam.e", glass=[], **front)
        np.testing.assert_allclose(solid.images([0])[1, 0][down, right, 3], 1)
        self.assertEqual(solid.rows[1].high, 9e8)

    def test_the_clip_shows_the_inside(self):
        places = box(6, 6, 6)
        inner = np.all(np.abs(places - 3 * H) < 1.2 * H, axis=1) * 1.0
        write_result(self.folder / "core.e", {"body": places}, np.zeros((2, len(places), 3)), {"Core": np.stack([inner] * 2)})
        for clip, expected in ((None, 0.0), ((1, 0.5), 1.0)):
            scene = self.scene("core.e", view=(0, -1, 0), frames=1, clip=clip, variables=["Core"])
            right, down = (int(p) for p in pixel(scene.camera, [3 * H, 0, 3 * H]))
            np.testing.assert_allclose(hue(scene.images([0])[0, 0][down, right]), hue(view.SCALE(expected)), atol=1e-6)

    def test_hidden_points_show_what_is_behind_them(self):
        places = box(6, 6, 6)
        front = (places[:, 1] < H) * 1.0
        write_result(self.folder / "crack.e", {"body": places}, np.zeros((2, len(places), 3)),
                     {"Damage": np.stack([0 * front, front]), "Behind": np.stack([1 - front] * 2)})
        scene = self.scene("crack.e", view=(0, -1, 0), frames=2, variables=["Behind"], hide=("Damage", 0.5))
        right, down = (int(p) for p in pixel(scene.camera, [3 * H, 0, 3 * H]))
        for column, expected in ((0, 0.0), (1, 1.0)):
            np.testing.assert_allclose(hue(scene.images([column])[0, column][down, right]), hue(view.SCALE(expected)),
                                       atol=1e-6)

    def test_errors_are_one_line_that_helps(self):
        self.bar()
        self.assertIn("no variable 'Von_Mises_Stres' (did you mean 'Von_Mises_Stress'?)",
                      self.error("bar.e", "a.png", "--variable", "Von_Mises_Stres"))
        self.assertIn("it has Displacement, Equivalent_Plastic_Strain", self.error("bar.e", "a.png", "--variable", "Q"))
        self.assertIn("nowhere.e does not exist", self.error("nowhere.e", "a.png"))
        self.assertIn("no block 'plate'; it has bar", self.error("bar.e", "a.png", "--blocks", "plate"))
        self.assertIn("no block 'bat' (did you mean 'bar'?); it has bar", self.error("bar.e", "a.png", "--blocks", "bat"))
        self.assertIn("times from 0 s to 0.001 s; found 5", self.error("bar.e", "a.png", "--times", 5))
        self.assertIn("--clip takes", self.error("bar.e", "a.png", "--clip", "q", 0.5))
        self.assertIn("--hide takes", self.error("bar.e", "a.png", "--hide", "Damage", "much"))
        self.assertIn("no variable 'Damag'", self.error("bar.e", "a.png", "--hide", "Damag", 0.5))
        self.assertIn("--hide hides all", self.error("bar.e", "a.png", "--hide", "Von_Mises_Stress", -1))
        self.assertIn("ends in .png", self.error("bar.e", "a.bmp"))
        (self.folder / "text.e").write_text("not a result")
        self.assertIn("text.e is not an Exodus file", self.error("text.e", "a.png"))
        write_result(self.folder / "mesh.e", {"bar": box(2, 2, 2)}, np.zeros((0, 8, 3)), {"S": np.zeros((0, 8))}, times=[])
        self.assertIn("mesh.e is not a result: it has no nodes or no frames", self.error("mesh.e", "a.png"))
        write_result(self.folder / "still.e", {"bar": box(2, 2, 2)}, np.zeros((1, 8, 3)), {"S": np.zeros((1, 8))}, [0], "ABC")
        self.assertIn("still.e has no variable Displacement", self.error("still.e", "a.png", "--variable", "S"))
        self.assertFalse((self.folder / "a.png").exists())


def deck_of(path, tools, history=""):
    """tools: name -> keys."""
    path.write_text(tree.tostring(section("deck", {"Boundary Conditions": tools, "History": {"Filename": history}}), "unicode"))
    return path


class RigidTools(InFolder):
    """Tools of a deck: where they are, and that they are seen there."""

    def test_a_tool_is_seen_as_glass_where_it_has_traveled_to(self):
        places = box(6, 6, 6)
        write_result(self.folder / "body.e", {"body": places}, np.zeros((2, len(places), 3)),
                     {"S": np.ones((2, len(places)))})
        deck = deck_of(self.folder / "body.xml", {
            "punch": {"Type": "Rigid Box", "Lower Corner": f"{2 * H} {2 * H} {6.5 * H}", "Upper Corner": f"{4 * H} {4 * H} {12 * H}",
                      "Travel Z": "-0.5*t"},  # by 0.5 H at the end
            "floor": {"Type": "Rigid Plane", "Point": "0 0 0", "Normal": "0 0 2"}})
        scene = view.Scene(Result(str(self.folder / "body.e")),
                           view.Wanted(variables=["S"], view=(0, -1, 0), tools=rigid.tools_of(str(deck))))
        images = scene.images([0, 1])

        def seen(column, x, z):
            right, down = (int(p) for p in pixel(scene.camera, [x * H, 0, z * H]))
            return images[0, column][down, right]
        # The picture shows the part of the punch below 6.9 H: from 6.5 H on before, from 6 H on after.
        for column, z, there in ((0, 6.25, False), (1, 6.25, True), (0, 6.7, True), (1, 6.7, True)):
            found = seen(column, 3, z)
            self.assertEqual(found[3] > 0.1, there, (column, z))
            if there:
                self.assertLess(found[3], 0.5, (column, z))
                np.testing.assert_allclose(hue(found), hue(view.GREY), atol=1e-6)
        self.assertEqual(seen(1, 1, 6.25)[3], 0)  # beside it
        self.assertGreater(seen(0, 3, -0.1)[3], 0.1)  # the floor's edge, 0.03 of the body's size thick
        done = self.run_tool("picture", "body.e", "body.png", "--tools", "body.xml", "--variable", "S")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertGreater((self.folder / "body.png").stat().st_size, 5000)

    def test_surfaces_are_closed_and_face_outwards(self):
        low, high = np.zeros(3), np.full(3, 6.0)
        roll = {"Type": "Rigid Cylinder", "Point": "3 0 7", "Axis": "0 2 0", "Radius": "1"}
        plane = {"Type": "Rigid Plane", "Point": "{1, 2, 3}", "Normal": "1, 1, 0"}  # lists as of YAML, too
        deck = deck_of(self.folder / "a.xml", {"roll": roll, "plane": plane})
        parts = [tool.surface(low, high) for tool in rigid.tools_of(str(deck))]
        # Volumes by the divergence theorem; VTK has some of its numbers in single precision. The roll reaches 0.15 of the size beyond the body at both ends; the
        # slab is 0.03 of it thick, and the body, sqrt(2) 6 wide across (1, 1, 0), has the margin on all sides.
        circle = 0.5 * rigid.ARC * np.sin(2 * np.pi / rigid.ARC)
        for part, expected in zip(parts, (circle * 7.8, 0.18 * (6 * 2**0.5 + 1.8) * 7.8)):
            triangles, volume = vtkTriangleFilter(), vtkMassProperties()
            triangles.SetInputData(part)
            volume.SetInputConnection(triangles.GetOutputPort())
            self.assertAlmostEqual(volume.GetVolume() / expected, 1, 6)
        front = surface.places_of(parts[1]) @ np.array([1, 1, 0])
        self.assertAlmostEqual(front.max(), 3, 6)  # x + y = 3 at the point

    def test_a_tool_with_a_mass_goes_as_the_forces_on_it_say(self):
        t = np.linspace(0, 1e-3, 11)
        rows = "\n".join(f"{x},{6 * max(x - 5e-5, 0)}" for x in t)  # means since the row before
        (self.folder / "h.csv").write_text("# strut\nTime,Reaction_Z(punch)\n" + rows + "\n")
        punch = {"Type": "Rigid Plane", "Point": "0 0 0", "Normal": "0 0 1", "Mass": "2", "Speed Z": "-3", "Force Z": "-4"}
        deck = deck_of(self.folder / "a.xml", {"punch": punch}, str(self.folder / "h.csv"))
        tool, = rigid.tools_of(str(deck))
        x = t[-1]  # m z'' = -4 - 6 t; trapezoids of a velocity that is quadratic err by its bend: 1.5 dt² x/6
        np.testing.assert_allclose(tool.offset(x), [0, 0, -3 * x - x**2 - 0.5 * x**3], atol=0.26 * (x / 10)**2 * x)
        self.assertNotEqual(tool.offset(x)[2], -3 * x)
        # A push between two rows has its impulse: v = -3 - 4e4 2e-5 / 2 after it.
        (self.folder / "h.csv").write_text("# strut\nTime,Reaction_Z(punch)\n" + "\n".join(f"{x},0" for x in t) + "\n")
        tool, = rigid.tools_of(str(deck_of(deck, {"punch": {**punch, "Force Z": "-4e4*(t < 2e-5)"}}, str(self.folder / "h.csv"))))
        self.assertAlmostEqual((tool.offset(x)[2] - tool.offset(x / 2)[2]) / (0.5 * x), -3.4, 9)
        # Whether a run that starts from another one goes on with its steps is not known here.
        deck.write_text(deck.read_text().replace("><", '><ParameterList name="Start From"/><', 1))
        with contextlib.redirect_stdout(io.StringIO()) as said:
            rigid.tools_of(str(deck))
        self.assertIn("the tool 'punch' is drawn as if it began where the deck has it", said.getvalue())

    def test_a_tool_with_a_mass_rests_in_the_equilibria_before_its_flight(self):
        (self.folder / "h.csv").write_text("# strut\nTime,Reaction_Z(punch)\n0,0\n0.5,0\n1,0\n1.001,0\n1.002,0\n")
        punch = {"Type": "Rigid Plane", "Point": "0 0 0", "Normal": "0 0 1", "Mass": "2", "Speed Z": "-3", "Force Z": "-4"}
        deck = {"Boundary Conditions": {"punch": punch}, "History": {"Filename": str(self.folder / "h.csv")},
                "Solver": {"Final Time": "1", "QuasiStatic": {}}, "Solver 2": {"Final Time": "1.002", "Verlet": {}}}
        (self.folder / "a.xml").write_text(tree.tostring(section("deck", deck), "unicode"))
        tool, = rigid.tools_of(str(self.folder / "a.xml"))
        self.assertEqual(tool.offset(1)[2], 0)
        self.assertAlmostEqual(tool.offset(1.002)[2], -3 * 2e-3 - 0.5 * 2 * 2e-3**2, 12)

    def test_what_cannot_be_drawn_is_told(self):
        (self.folder / "h.csv").write_text("Time\n0\n1\n")
        write_result(self.folder / "body.e", {"body": box(2, 2, 2)}, np.zeros((2, 8, 3)), {"S": np.ones((2, 8))})
        for tools, words in (({}, "has no rigid tools"),
                             ({"roll": {"Type": "Rigid Plane", "Point": "0 0 0", "Normal": "0 0 1", "Mass": "1", "Speed X": "1"}},
                              "follows from Reaction_X(roll): add it to the deck's History")):
            deck_of(self.folder / "a.xml", tools, "h.csv")
            done = self.run_tool("picture", "body.e", "a.png", "--tools", "a.xml")
            self.assertIn(words, done.stderr)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1))


def volume_of(found):
    """By the divergence theorem."""
    p = found.corners[found.quads]
    return np.sum(0.5 * np.cross(p[:, 2] - p[:, 0], p[:, 3] - p[:, 1]) * p.mean(axis=1)) / 3


def pieces_of(found):
    ends = np.stack([found.quads, np.roll(found.quads, 1, axis=1)], axis=2).reshape(-1, 2)
    return connected_components(coo_array((np.ones(len(ends)), ends.T), (len(found.corners),) * 2))[0]


class Surfaces(unittest.TestCase):
    def assert_closed(self, found):
        edges = np.sort(np.stack([found.quads, np.roll(found.quads, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
        edges = edges[edges[:, 0] != edges[:, 1]]
        self.assertTrue((np.unique(edges, axis=0, return_counts=True)[1] % 2 == 0).all())

    def test_a_box_has_its_volume_and_one_closed_surface(self):
        for shape in ((5, 4, 3), (6, 6, 1), (20, 20, 20)):
            count = np.prod(shape)
            found = surface.surface_of(box(*shape), np.full(count, H**3), np.arange(count))
            # The level of the surface, at most 0.8, restores the volume that rounding takes from the edges: a body keeps
            # its volume within 5 %, a single layer lacks up to a fifth of it.
            self.assertAlmostEqual(volume_of(found) / (count * H**3), 1, delta=0.2 if 1 in shape else 0.05)
            self.assertEqual(pieces_of(found), 1)
            self.assert_closed(found)

    def test_a_point_alone_is_drawn_however_little_of_its_cell_is_filled(self):
        for fill in (0.01, 0.5, 1):
            found = surface.surface_of(box(1, 1, 1), np.array([fill * H**3]), np.array([0]))
            self.assertGreater(len(found.quads), 0)
        far = np.concatenate([box(2, 1, 1), box(1, 1, 1, (9 * H, 0, 0))])
        self.assertEqual(pieces_of(surface.surface_of(far, np.full(3, H**3), np.arange(3))), 2)

    def test_cells_that_are_longer_along_one_axis_are_one_body(self):
        places, volumes = box(6, 6, 6) * [1, 1, 2.5], np.full(216, 2.5 * H**3)
        found = surface.surface_of(places, volumes, np.arange(216))
        self.assertEqual(pieces_of(found), 1)
        self.assertAlmostEqual(volume_of(found) / volumes.sum(), 1, delta=0.1)

    def test_faces_belong_to_the_nearest_point_and_move_with_it(self):
        places = box(5, 4, 3)
        found = surface.surface_of(places, np.full(60, H**3), np.arange(60))
        middles = found.corners[found.quads].mean(axis=1)
        nearest = np.linalg.norm(middles[:, None] - places, axis=2).min(axis=1)
        np.testing.assert_allclose(np.linalg.norm(middles - places[found.point], axis=1), nearest)
        np.testing.assert_allclose(found.moved(np.full((60, 3), 0.7 * H))[0], found.corners + 0.7 * H, rtol=1e-12)

    def test_no_sheets_are_drawn_between_points_that_are_torn_apart(self):
        places = box(6, 3, 3)
        found = surface.surface_of(places, np.full(54, H**3), np.arange(54))
        corners, quads = found.moved(np.where(places[:, :1] > 3 * H, [[5 * H, 0, 0]], 0.0))  # a gap of five cubes
        used = corners[quads]
        self.assertFalse(((used[..., 0] > 3.6 * H) & (used[..., 0] < 7.4 * H)).any())
        self.assertLess(np.linalg.norm(used - np.roll(used, 1, axis=1), axis=2).max(), 1.2 * H)
        self.assertEqual(len(quads), len(found.quads))
        places, volumes = self.gathered()
        found = surface.surface_of(places, volumes, np.arange(60))
        corners, quads = found.moved(np.where(np.arange(60)[:, None] >= 30, [[0, 0, 4 * H]], 0.0))
        z = corners[quads][..., 2]
        self.assertFalse(((z > 1.2 * H) & (z < 2.8 * H)).any())
        stretched = np.outer(np.arange(60), [0.8 * H, 0.6 * H, 0])  # drawn out to twice its length it is one strut
        np.testing.assert_array_equal(found.moved(stretched)[1], found.quads)

    def test_points_of_very_different_distances_are_cubes_by_themselves(self):
        x = 1.4**np.arange(7) * H
        places = np.stack(np.meshgrid(x, x, x, indexing="ij"), -1).reshape(-1, 3)
        found = surface.surface_of(places, 0.06 * places.prod(axis=1), np.arange(343))
        self.assertEqual(len(found.quads), 343 * 6)
        self.assertAlmostEqual(volume_of(found) / (0.06 * places.prod(axis=1).sum()), 1, 9)

    @staticmethod
    def gathered(count=60):
        """A row of partly filled cells of edge H along a slanted line: places and volumes."""
        random = np.random.default_rng(2)
        direction = np.array([0.8, 0.6, 0])
        return direction * H * np.arange(count)[:, None] + random.uniform(-0.05, 0.05, (count, 3)) * H, random.uniform(0.4, 0.9, count) * H**3

    def test_partly_filled_cells_are_one_strut_of_their_volume(self):
        places, volumes = self.gathered()
        found = surface.surface_of(places, volumes, np.arange(60))
        self.assertEqual(pieces_of(found), 1)
        self.assert_closed(found)
        self.assertEqual(set(found.point), set(range(60)))
        # Three places of the sum lie across the strut, between which its surface goes on a straight line, inside of the circle.
        self.assertAlmostEqual(volume_of(found) / volumes.sum(), 1, delta=0.15)

    def test_struts_that_are_apart_are_not_joined(self):
        places, volumes = self.gathered()
        both = np.concatenate([places, places + [0, 0, 2 * H]]), np.tile(volumes, 2)
        self.assertEqual(pieces_of(surface.surface_of(*both, np.arange(120))), 2)

    def test_the_nearer_of_two_surfaces_is_seen_and_without_holes(self):
        camera = painter.Camera((0.3, -1, 0.4))
        both = surface.joined([surface.surface_of(box(20, 1, 20, (0, y * H, 0)), None, np.full(400, y)) for y in (5, 0)])
        corners = camera.seen(both.corners)
        camera.frame(corners.min(axis=0), corners.max(axis=0), 200, 200)
        seen = painter.Solid(painter.Painter(), surface.polydata(both.corners, both.quads), both.point, camera)
        point = np.full(seen.seen.shape, -1)
        point[seen.seen] = seen.point
        column, row = (int(painter.FINER * p) for p in pixel(camera, [10 * H, 0, 10 * H]))
        self.assertTrue(np.all(point[row - 60:row + 60, column - 60:column + 60] == 0))
        # The depth of the wall itself: y = 0 is nearer than y = 5 H.
        self.assertAlmostEqual(seen.near[row, column], camera.seen(np.array([10 * H, 0, 10 * H]))[2] - camera.middle[2], delta=H)


if __name__ == "__main__":
    unittest.main()
