"""Points are computed once, those that fail are told, and a study that was stopped goes on."""

import pathlib
import signal

from study_folder import CASE, FAKE, STUDY, StudyCase


class StartsTest(StudyCase):
    def test_a_point_is_computed_once(self):
        self.start()
        self.assertEqual(len(self.starts()), 6)
        self.start()
        self.assertEqual(len(self.starts()), 6)
        self.write(STUDY.replace("0.2, 0.1, 0.05", "0.2, 0.1, 0.05, 0.025"))
        self.start()
        self.assertEqual(self.starts()[6:], ["P1P1_size_0.025", "P2P1_size_0.025"])

    def test_a_point_is_computed_again_when_the_case_or_the_version_has_changed(self):
        self.start()
        self.write(STUDY, CASE + "seconds = 0.01\n")
        self.start()
        self.assertEqual(len(self.starts()), 12)
        self.write(STUDY, CASE + "seconds = 0.01\n[expected.drag_frequency_Hz]\nvalue = 1\n")  # changes no result
        self.start()
        self.assertEqual(len(self.starts()), 12)
        note = self.folder / "out/made_up/points/P1P1_size_0.1/measured.json"
        note.write_text(note.read_text(encoding="utf-8").replace("9.9.9", "9.9.8"), encoding="utf-8")
        self.start()
        self.assertEqual(self.starts()[12:], ["P1P1_size_0.1"])
        self.start("--anew")
        self.assertEqual(len(self.starts()), 19)

    def test_a_failed_point_is_kept_shown_and_run_again_only_when_asked(self):
        self.write(STUDY, CASE + "fails_at = 0.2\n")
        words = self.start("--table", "table.md")
        self.assertIn("P1P1, size 0.2: failed, the flow did not converge at 0.1 s", words)
        failed = [row for row in self.rows() if row["status"] == "failed"]
        self.assertEqual([row["point"] for row in failed], ["P1P1, size 0.2", "P2P1, size 0.2"])
        for row in failed:
            self.assertEqual((row["value"], row["front"]), ("", "no"))
            self.assertGreater(float(row["core_s"]), 0)
        for name in ("out/made_up/study.html", "table.md"):
            self.assertIn("the flow did not converge at 0.1 s", (self.folder / name).read_text(encoding="utf-8"))
        self.start()
        self.assertEqual(len(self.starts()), 6)
        self.start("--again")
        self.assertEqual(self.starts()[6:], ["P1P1_size_0.2", "P2P1_size_0.2"])

    def test_a_crash_is_a_failed_point_with_its_last_words(self):
        self.write(STUDY, CASE + "kills_at = 0.05\n")
        words = self.start()
        self.assertIn("failed, ended with exit code -9: the last words of a crash", words)
        self.assertEqual(sum(row["status"] == "failed" for row in self.rows()), 2)

    def test_after_ctrl_c_nothing_is_left_running_and_the_same_command_goes_on(self):
        self.write(STUDY, CASE + "waits_at = 0.05\n")
        process = self.start_in_background()
        self.wait_for_starts(3)
        children = self.children(process.pid)
        process.send_signal(signal.SIGINT)
        words = process.communicate(timeout=30)[0].decode()
        self.assertEqual(process.returncode, 130, words)
        self.assertIn("goes on from here", words)
        self.assertEqual(len(children), 1)
        self.assertFalse(pathlib.Path(f"/proc/{children[0]}").exists())
        self.assertEqual({row["status"] for row in self.rows()}, {"finished", "waiting"})
        self.write(STUDY)  # the key that waits is gone: the case has changed, and all are computed
        self.start()
        self.assertEqual({row["status"] for row in self.rows()}, {"finished"})

    def test_points_at_once_are_noted(self):
        self.start("--jobs", "3")
        self.assertEqual({row["points_at_once"] for row in self.rows()}, {"3"})

    def test_a_second_call_does_not_work_in_the_same_folder(self):
        self.write(STUDY, CASE + "waits_at = 0.2\n")
        first = self.start_in_background()
        self.wait_for_starts(1)
        self.assertIn("another call works", self.start("--draw", code=2))
        first.terminate()
        words = first.communicate(timeout=30)[0].decode()
        self.assertEqual(first.returncode, 130, words)

    def test_core_seconds_count_all_processes_and_wall_seconds_the_wait(self):
        self.write(STUDY, CASE + "seconds = 0.1\n")
        self.start(program=f"/bin/sh -c '\"$0\" \"$@\" & \"$0\" \"$@\"; wait' {FAKE}")  # two processes, 0.1 s each
        for row in self.rows():
            self.assertGreater(float(row["core_s"]), 0.2)
            self.assertLess(float(row["core_s"]), 3)
            self.assertGreater(float(row["wall_s"]), 0.1)
