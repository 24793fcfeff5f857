"""The audit of the truth, as a user runs it: what it says, and what it ends with."""
import base64
import json
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

TIMEOUT_S = 300
SOUND, NOT_SOUND, BAD_INPUT = 0, 1, 2
CELLS = 120  # of a sheet in a picture of 48 pixels: triangles far smaller than a pixel


def crumpled_sheet():
    """glTF of a sheet whose pixels show whichever of many triangles the rasteriser's snapping leaves there."""
    side = CELLS + 1
    heights = [((x * 7919 + z * 104729) % 97) / 970.0 for z in range(side) for x in range(side)]
    positions = b"".join(struct.pack("<3f", x / 10.0 - 6.0, heights[z * side + x], z / 10.0 - 6.0)
                         for z in range(side) for x in range(side))
    corners = [i + z * side + x for z in range(CELLS) for x in range(CELLS)
               for i in (0, side, 1, 1, side, side + 1)]
    indices = struct.pack("<%dI" % len(corners), *corners)
    data = base64.b64encode(positions + indices).decode()
    return {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "buffers": [{"byteLength": len(positions) + len(indices),
                     "uri": "data:application/octet-stream;base64," + data}],
        "bufferViews": [{"buffer": 0, "byteLength": len(positions)},
                        {"buffer": 0, "byteOffset": len(positions), "byteLength": len(indices)}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": side * side, "type": "VEC3",
                       "min": [-6, 0, -6], "max": [6, 0.1, 6]},
                      {"bufferView": 1, "componentType": 5125, "count": len(corners), "type": "SCALAR"}]}


class AuditTest(unittest.TestCase):
    bench = None

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="gnomon_audit_")
        self.addCleanup(shutil.rmtree, self.folder, True)

    def audit(self, *flags):
        """Exit code, what it printed, and the audits of its JSON."""
        file = os.path.join(self.folder, "audit.json")
        done = subprocess.run([self.bench, "audit", "--json", file, *flags], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, timeout=TIMEOUT_S, check=False)
        audits = []
        if os.path.exists(file):
            with open(file, encoding="utf-8") as stream:
                audits = json.load(stream)["audits"]
        return done.returncode, done.stdout.decode(), audits

    def test_every_camera_and_light_of_the_built_in_scenes_is_audited_and_sound(self):
        code, text, audits = self.audit("--size", "480x270")
        self.assertEqual(code, SOUND, text)
        self.assertIn("\nsound\n", text)
        courtyard = [audit for audit in audits if audit["scene"] == "built-in"]
        self.assertEqual([audit["camera"] for audit in courtyard], ["main", "top", "low"])
        for audit in courtyard:
            self.assertEqual([light["name"] for light in audit["lights"]], ["sun", "lantern", "guard_lamp"])
            for light in audit["lights"]:
                self.assertGreater(light["compared_px"], 1000)

    def test_a_bound_that_is_broken_is_said_listed_and_the_exit_code(self):
        scene = os.path.join(self.folder, "sheet.gltf")
        with open(scene, "w", encoding="utf-8") as stream:
            json.dump(crumpled_sheet(), stream)
        code, text, audits = self.audit("--scene", scene, "--size", "48x27")
        self.assertEqual(code, NOT_SOUND, text)
        self.assertIn("ABOVE ITS BOUND", text)
        self.assertEqual(len(audits), 1)
        others = [at for at in audits[0]["other_triangles"] if not at["in_one_plane"]]
        self.assertGreater(len(others), 0)
        self.assertAlmostEqual(len(others) / audits[0]["surface_px"], audits[0]["other_surface"])
        self.assertFalse(audits[0]["sound"])
        for light in audits[0]["lights"]:
            self.assertEqual(light["disagreements"], [], "nothing is compared where other triangles are seen")

    def test_what_cannot_be_audited_is_bad_input(self):
        self.assertEqual(self.audit("--scene", os.path.join(self.folder, "none.gltf"))[0], BAD_INPUT)
        self.assertEqual(self.audit("--camera", "none")[0], BAD_INPUT)


if __name__ == "__main__":
    AuditTest.bench = sys.argv.pop(1)
    unittest.main(verbosity=2)
