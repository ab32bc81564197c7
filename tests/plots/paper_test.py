"""Tests results/paper/*.json against the paper's own arithmetic, which finds typing errors."""
import json
import pathlib
import unittest

PAPER = pathlib.Path(__file__).resolve().parents[2] / "results" / "paper"


def load(name: str) -> dict:
    return json.loads((PAPER / f"{name}.json").read_text(encoding="utf-8"))


def oi_nodes(triangles: int) -> int:
    """Returns the number of nodes by Eq. (7): 2t - 1 + popcount(L_v)."""
    virtual = (1 << (triangles - 1).bit_length()) - triangles
    return 2 * triangles - 1 + virtual.bit_count()


def last_digit(printed: str) -> float:
    """Returns the value of one unit in the last printed digit. The paper truncates as often as it rounds."""
    mantissa, _, exponent = printed.partition("e")
    decimals = len(mantissa.partition(".")[2])
    return 10.0 ** (int(exponent or 0) - decimals)


def column(table: dict, key: str, value: str) -> dict[tuple[str, str], float]:
    """Returns a column of the table by (scene, value of `key`)."""
    return {(row["scene"], row[key]): row[value] for row in table["rows"]}


class PrintedNumbers(unittest.TestCase):
    def assert_printed(self, computed: float, printed: str, what: str) -> None:
        difference = abs(computed - float(printed))
        self.assertLessEqual(difference, last_digit(printed), f"{what}: {computed} is printed as {printed}")

    def test_table1_node_counts_follow_from_the_triangles(self) -> None:
        for row in load("table1")["rows"]:
            triangles = row["triangles"]
            expected = {
                "perfect": 2 * (1 << (triangles - 1).bit_length()) - 1,
                "apetrei": 2 * triangles - 1,
                "oibvh-single": oi_nodes(triangles),
                "oibvh-multi": oi_nodes(triangles),
            }[row["builder"]]
            self.assertEqual(row["nodes_count"], expected, row)

    def test_table1_padding_is_the_share_of_surplus_nodes(self) -> None:
        for row in load("table1")["rows"]:
            surplus = row["nodes_count"] - (2 * row["triangles"] - 1)
            self.assert_printed(100 * surplus / row["nodes_count"], row["padding_percent"], str(row))

    def test_table1_speedups_follow_from_the_times(self) -> None:
        table = load("table1")
        time = column(table, "builder", "hierarchy_ms")
        self.assertEqual(len(table["rows"]), 5 * 4)
        for ratio in table["ratios"]:
            scene = ratio["scene"]
            fastest = min(time[scene, "oibvh-single"], time[scene, "oibvh-multi"])
            self.assert_printed(time[scene, "apetrei"] / fastest, ratio["apetrei_over_fastest_oibvh"], scene)

    def test_table2_and_3_ratios_follow(self) -> None:
        for name, scenes, peer_method, of_times, of_memory in (
                ("table2", 4, "wang-2018", "wang_over_oibvh_time", "oibvh_of_wang_memory_percent"),
                ("table3", 3, "i-cloth", "icloth_over_oibvh_time", "memory_reduction_percent")):
            table = load(name)
            time, memory = column(table, "method", "frame_ms"), column(table, "method", "memory_megabytes")
            self.assertEqual(len(table["rows"]), scenes * 2)
            for ratio in table["ratios"]:
                peer, ours = (ratio["scene"], peer_method), (ratio["scene"], "oibvh")
                self.assert_printed(time[peer] / time[ours], ratio[of_times], ratio["scene"])
                share = 100 * memory[ours] / memory[peer]
                self.assert_printed(100 - share if name == "table3" else share, ratio[of_memory], ratio["scene"])

    def test_table4_ratios_follow(self) -> None:
        table = load("table4")
        cost = column(table, "builder", "sah_cost")
        self.assertEqual(len(table["rows"]), 3 * 2)
        for ratio in table["ratios"]:
            scene = ratio["scene"]
            increase = cost[scene, "oibvh-multi"] / cost[scene, "apetrei"]
            self.assert_printed(increase, ratio["oibvh_over_apetrei_sah"], scene)

    def test_figure8_crossing_is_the_power_of_two_of_the_text(self) -> None:
        self.assertEqual(load("fig8")["crossing_triangles"], 2**17)
