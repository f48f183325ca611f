# SPDX-License-Identifier: MIT
"""The promise: a cache has the same bytes, whoever fills it and however often it is interrupted: one process, shards, ranks of MPI,
workers of Dask, tasks of Slurm, two writers at once."""
import os
import random
import shutil
import signal
import subprocess
import sys
import time

from stage import BUDGET, LIMITED, ROOT, STEPS, SWIVEL, Stage, files_of, run, unittest

CROWDS = {"plain": "", "limited": LIMITED, "steps": STEPS, "budget": BUDGET}


def environment(**more):
    """Of a process that no scheduler has started."""
    return {name: value for name, value in os.environ.items() if not name.startswith(("SLURM", "OMPI", "PMI"))} | more


class SameBytes(Stage):
    def test_four_shards_leave_what_one_process_leaves(self):
        for name, toml in CROWDS.items():
            with self.subTest(crowd=name):
                empty = self.store(f"{name}-empty", toml=toml)
                one = self.fill(shutil.copytree(empty, self.folder / f"{name}-one"))
                four = shutil.copytree(empty, self.folder / f"{name}-four")
                order = ["3/4", "1/4", "4/4", "2/4"]
                for shard in order:
                    self.assertEqual(self.fill(four, "--shard", shard), four)
                self.assert_same(one, four)
                self.assertGreater(len(files_of(one)), len(files_of(empty)))
                self.swivel("check", one, "--quiet")

    def test_threads_and_memory_change_nothing(self):
        empty = self.store(toml=LIMITED)
        one = self.fill(shutil.copytree(empty, self.folder / "one"), "--threads", "1", "--memory", "64M")
        self.assert_same(one, self.fill(empty, "--threads", "2", "--memory", "2G"))

    def test_two_writers_of_the_same_chunks_both_finish(self):
        empty = self.store(toml=BUDGET, characters=300)
        one = self.fill(shutil.copytree(empty, self.folder / "one"))
        two = shutil.copytree(empty, self.folder / "two")
        writers = [subprocess.Popen([SWIVEL, "fill", two, "--resume", "--quiet"], stderr=subprocess.PIPE, text=True) for _ in range(2)]
        self.assertEqual([writer.communicate()[1] for writer in writers], ["", ""])
        self.assertEqual([writer.returncode for writer in writers], [0, 0])
        self.assert_same(one, two)

    def test_killed_ten_times_and_resumed(self):
        choose = random.Random(7)
        for name in ("limited", "budget"):
            with self.subTest(crowd=name):
                empty = self.store(f"{name}-empty", toml=CROWDS[name], characters=2000, frames=64)
                began = time.monotonic()
                one = self.fill(shutil.copytree(empty, self.folder / f"{name}-one"))
                whole = time.monotonic() - began
                killed, kills = shutil.copytree(empty, self.folder / f"{name}-killed"), 0
                while kills < 10:
                    process = subprocess.Popen([SWIVEL, "fill", killed, "--resume", "--quiet"])
                    time.sleep(choose.uniform(0, whole / 4))
                    process.send_signal(signal.SIGKILL)
                    if process.wait() == 0:  # it was done before: once more from the start
                        shutil.rmtree(killed)
                        shutil.copytree(empty, killed)
                    kills += 1
                self.fill(killed, "--resume")
                self.swivel("check", killed, "--quiet")
                self.swivel("check", one, "--quiet")
                self.assert_same(one, killed)  # check has removed what killed writers left


class Engines(Stage):
    def setUp(self):
        super().setUp()
        self.empty = self.store("empty", toml=BUDGET)
        self.one = self.fill(shutil.copytree(self.empty, self.folder / "one"))
        self.other = shutil.copytree(self.empty, self.folder / "other")
        self.path = f"{os.path.dirname(SWIVEL)}:{os.environ['PATH']}"

    def example(self, *command, **more):
        done = subprocess.run(command, cwd=self.folder, env=environment(PATH=self.path, **more), capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def test_ranks_of_mpi(self):
        said = self.example("bash", str(ROOT / "examples/cache/mpi.sh"), str(self.other), "4", OMPI_ALLOW_RUN_AS_ROOT="1",
                            OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
        for rank in range(4):
            self.assertIn(f"shard    {rank + 1}/4 of the cache, by OMPI_COMM_WORLD_RANK={rank} OMPI_COMM_WORLD_SIZE=4", said)
        self.assert_same(self.one, self.other)

    def test_workers_of_dask(self):
        said = self.example(sys.executable, str(ROOT / "examples/cache/dask_fill.py"), str(self.other))
        self.assertRegex(said, r"^2 workers wrote \d+ chunks\n")
        self.assert_same(self.one, self.other)

    def test_array_of_slurm(self):
        slurm = Slurm(self.folder / "slurm")
        self.addCleanup(slurm.stop)
        self.example("sbatch", "--wait", f"--output={self.folder}/said-%a", str(ROOT / "examples/cache/slurm.sbatch"), str(self.other),
                     SLURM_CONF=str(slurm.conf))
        for task in range(4):
            said = (self.folder / f"said-{task}").read_text()
            self.assertIn(f"shard    {task + 1}/4 of the cache, by SLURM_ARRAY_TASK_ID={task} SLURM_ARRAY_TASK_COUNT=4", said)
        self.assert_same(self.one, self.other)
        self.steps_of_slurm(slurm)

    def steps_of_slurm(self, slurm):
        """A batch script is one process, which no part is meant for; srun starts one for each."""
        shutil.rmtree(self.other)
        shutil.copytree(self.empty, self.other)
        fill = f"swivel fill {self.other} --shard auto --resume --threads 1"
        command = f"{fill}; srun --overlap {fill}"
        self.example("sbatch", "--wait", "--ntasks=2", "--cpus-per-task=1", f"--output={self.folder}/said-steps", f"--wrap={command}",
                     SLURM_CONF=str(slurm.conf))
        said = (self.folder / "said-steps").read_text()
        self.assertIn("swivel: --shard auto: SLURM_PROCID=0 and no SLURM_STEP_NUM_TASKS: start it by srun or mpirun", said)
        for task in range(2):
            self.assertIn(f"shard    {task + 1}/2 of the cache, by SLURM_PROCID={task} SLURM_STEP_NUM_TASKS=2", said)
        self.assert_same(self.one, self.other)

    def test_auto_needs_a_scheduler(self):
        done = run("fill", self.other, "--shard", "auto", env=environment())
        self.assert_refused(done, "--shard auto: no variables of Slurm or MPI are set", code=2)
        done = run("fill", self.other, "--shard", "auto", env=environment(OMPI_COMM_WORLD_RANK="4", OMPI_COMM_WORLD_SIZE="4"))
        self.assert_refused(done, "OMPI_COMM_WORLD_RANK=4 OMPI_COMM_WORLD_SIZE=4: the index is not among that many", code=2)
        self.assert_same(self.empty, self.other)

    def test_auto_reads_the_tasks_of_slurm(self):
        def array(index, count, least, most, step):
            names = {"ID": index, "COUNT": count, "MIN": least, "MAX": most, "STEP": step}
            return environment(**{f"SLURM_ARRAY_TASK_{name}": str(number) for name, number in names.items()})

        for index, part in ((0, 1), (2, 2), (6, 4)):  # --array=0-6:2
            done = run("fill", self.other, "--shard", "auto", "--resume", env=array(index, 4, 0, 6, 2))
            self.assertIn(f"shard    {part}/4 of the cache, by SLURM_ARRAY_TASK_ID={index}", done.stdout)
        shutil.rmtree(self.other)
        shutil.copytree(self.empty, self.other)
        for index in (1, 3, 7):  # --array=1,3,7
            done = run("fill", self.other, "--shard", "auto", env=array(index, 3, 1, 7, 1))
            self.assert_refused(done, "SLURM_ARRAY_TASK_STEP=1: the array's tasks have gaps; number them evenly, such as --array=0-7", code=2)
        for index in (1, 3, 9):  # of --array=2-6:2
            done = run("fill", self.other, "--shard", "auto", env=array(index, 3, 2, 6, 2))
            self.assert_refused(done, "the index is not among that many", code=2)
        batch = environment(SLURM_PROCID="0", SLURM_NTASKS="4", SLURM_JOB_ID="1")
        done = run("fill", self.other, "--shard", "auto", env=batch)
        self.assert_refused(done, "SLURM_PROCID=0 and no SLURM_STEP_NUM_TASKS: start it by srun or mpirun, or give --shard i/n", code=2)
        self.assert_same(self.empty, self.other)
        done = run("fill", self.other, "--shard", "auto", env=batch | {"SLURM_STEP_NUM_TASKS": "4", "SLURM_PROCID": "3"})
        self.assertIn("shard    4/4 of the cache, by SLURM_PROCID=3 SLURM_STEP_NUM_TASKS=4: ", done.stdout)

    def test_a_shard_without_work_says_so(self):
        said = self.swivel("fill", self.other, "--shard", "99/99")
        self.assertIn("shard    99/99 of the cache, by --shard: 0 chunks; there are fewer pieces of work than shards\n", said)

    def test_a_scheduler_is_not_asked_unless_it_is_named(self):
        subprocess.run([SWIVEL, "fill", self.other, "--quiet"], check=True,
                       env=environment(OMPI_COMM_WORLD_RANK="1", OMPI_COMM_WORLD_SIZE="4"))
        self.assert_same(self.one, self.other)


class Slurm:
    """Slurm's daemons on this machine alone, in a folder of their own, for one test. They need root."""

    def __init__(self, folder):
        host = os.uname().nodename.split(".")[0]
        for part in ("state", "spool"):
            (folder / part).mkdir(parents=True)
        (folder / "munge.key").write_bytes(os.urandom(128))
        (folder / "munge.key").chmod(0o600)
        self.conf, self.folder = folder / "slurm.conf", folder
        names = {"ClusterName": "swivel", "SlurmctldHost": f"{host}(127.0.0.1)", "SlurmUser": "root", "SlurmdUser": "root",
                 "AuthInfo": f"socket={folder}/munge.socket", "SlurmctldPort": 16817, "SlurmdPort": 16818,
                 "StateSaveLocation": folder / "state", "SlurmdSpoolDir": folder / "spool",
                 "SlurmctldPidFile": folder / "slurmctld.pid", "SlurmdPidFile": folder / "slurmd.pid",
                 "SlurmctldLogFile": folder / "slurmctld.log", "SlurmdLogFile": folder / "slurmd.log",
                 "ProctrackType": "proctrack/linuxproc", "TaskPlugin": "task/none", "MpiDefault": "none",
                 "AccountingStorageType": "accounting_storage/none", "SelectType": "select/cons_tres", "ReturnToService": 2}
        lines = [f"{name}={value}" for name, value in names.items()]
        lines += [f"NodeName={host} NodeAddr=127.0.0.1 CPUs=2", f"PartitionName=main Nodes={host} Default=YES State=UP"]
        self.conf.write_text("\n".join(lines) + "\n")
        munge = [f"--{part}-file={folder}/munge.{part}" for part in ("key", "log", "seed", "pid")]
        subprocess.run(["munged", "--force", f"--socket={folder}/munge.socket", *munge], check=True)
        for daemon in ("slurmctld", "slurmd"):
            subprocess.run([daemon, "-f", self.conf], check=True)

    def stop(self):
        for name in ("slurmd.pid", "slurmctld.pid", "munge.pid"):
            path = self.folder / name
            if path.exists():
                os.kill(int(path.read_text()), signal.SIGTERM)
                while path.exists():
                    time.sleep(0.05)


if __name__ == "__main__":
    unittest.main()
