# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""Studies: buildings are simulated, run with several sets of parameters, evaluated and averaged.

What is measured and shown, a Study says; walls.py and rooms.py are such.
"""
import csv
import json
import shutil
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Dict, NamedTuple, Optional

from cases import (all_cases, input_options, parsed, parser_of_cases, programs_of, run_program,
                   simulate)
from tables import print_columns


class Study(NamedTuple):
    name: str  # of its table DIR/<name>.csv
    description: str
    # Column of the csv: where it is in a run of `sgraphs_evaluate --json`; the last step may be a
    # function of what is there.
    measured: Dict[str, tuple]
    ratios: Dict[str, str]  # Column of the table: the measured one that is put in proportion.
    shown: Dict[str, int]  # Column of the table: digits.
    variants: Dict[str, Optional[str]]  # Without --variant: parameters by name, None: the defaults.
    note: str  # Below the table.


class Variant(NamedTuple):
    name: str
    params: Optional[Path]  # None: the defaults


def measured_in(evaluation, steps):
    """None if it was not measured."""
    value = evaluation
    for step in steps:
        if value is None:
            return None
        value = step(value) if callable(step) else value[step]
    return value


def evaluated(case, run, programs):
    """What sgraphs_evaluate says of a run."""
    evaluate = [programs / "sgraphs_evaluate", "--truth", case.truth, run, "--json"]
    if case.rooms is not None:
        evaluate += ["--rooms", case.rooms]
    run_program(evaluate, run / "evaluation.json")
    return json.loads((run / "evaluation.json").read_text())["runs"][0]


def measured_columns(evaluation, measured):
    """The part of a row that a Study's `measured` says where to find."""
    return {column: measured_in(evaluation, steps) for column, steps in measured.items()}


def run_variant(case, variant, study, arguments, programs):
    """A row of the csv."""
    out = arguments.out / "runs" / case.name / variant.name
    out.mkdir(parents=True, exist_ok=True)
    command = [programs / "sgraphs_offline", *input_options(case, arguments), "--out", out,
               "--quiet"]
    if variant.params is not None:
        command += ["--params", variant.params]
    run_program(command, out / "run.log")
    return {"set": case.set, "sensor": case.sensor, "rotation_deg": case.rotation_deg,
            "seed": case.seed, "variant": variant.name, "group": case.group,
            **measured_columns(evaluated(case, out, programs), study.measured)}


def measure(case, variants, study, arguments, programs):
    """The rows of one bag; a run that fails is told and left out."""
    rows = []
    try:
        if case.building is not None:
            simulate(case, programs)
        for variant in variants:
            print(f"{case.name}: {variant.name} ...", file=sys.stderr, flush=True)
            rows.append(run_variant(case, variant, study, arguments, programs))
    except RuntimeError as error:
        print(f"{case.name}: {error}", file=sys.stderr, flush=True)
    if arguments.drop_bags and case.building is not None:
        shutil.rmtree(case.bag.parent, ignore_errors=True)
    return rows


def mean(values):
    """None if nothing is known."""
    known = [value for value in values if value is not None]
    return sum(known) / len(known) if known else None


def ratio_of(column, rows, reference_rows):
    """Of means over the seeds that both have; None without any."""
    reference = {(row["group"], row["seed"]): row[column] for row in reference_rows}
    both = [(row[column], reference.get((row["group"], row["seed"]))) for row in rows]
    both = [(a, b) for a, b in both if a is not None and b is not None]
    below = sum(b for _, b in both)
    return sum(a for a, _ in both) / below if below else None


def table_row(group, variant, rows, reference_rows, study):
    """Means of runs."""
    texts = {}
    for column, digits in study.shown.items():
        if column in study.ratios:
            value = ratio_of(study.ratios[column], rows, reference_rows)
        else:
            value = mean([row[column] for row in rows])
        texts[column] = "-" if value is None else f"{value:.{digits}f}"
    return {"set": group, "variant": variant, "runs": len(rows), **texts}


def print_table(rows, variants, study):
    def of(variant, group=None):
        return [row for row in rows
                if row["variant"] == variant and group in (None, row["group"])]

    groups = list(dict.fromkeys(row["group"] for row in rows))
    reference = variants[-1].name
    lines = [table_row(group, variant.name, of(variant.name, group), of(reference, group), study)
             for group in groups for variant in variants if of(variant.name, group)]
    if len(groups) > 1:
        lines += [table_row("all", variant.name, of(variant.name), of(reference), study)
                  for variant in variants if of(variant.name)]
    print_columns(["set", "variant", "runs", *study.shown], lines)
    print(f"\nMeans over the seeds; ratios against '{reference}'.\n{study.note}")


def default_variants(study, folder):
    for name, params in study.variants.items():
        file = None
        if params is not None:
            file = folder / f"{name}.yaml"
            file.write_text(params)
        yield Variant(name, file)


def variants_of(study, arguments):
    if not arguments.variant:
        return list(default_variants(study, arguments.out))
    variants = []
    for text in arguments.variant:
        name, equals, file = text.partition("=")
        if not name or not equals:
            raise SystemExit(f"--variant '{text}' is not NAME=FILE")
        variants.append(Variant(name, Path(file) if file else None))
    return variants


def write_csv(rows, study, path):
    columns = ["set", "sensor", "rotation_deg", "seed", "variant", *study.measured]
    with open(path, "w", newline="") as file:
        table = csv.DictWriter(file, columns, extrasaction="ignore")
        table.writeheader()
        table.writerows(rows)


def conduct(study):
    """The main program of a study."""
    parser = parser_of_cases(study.name, study.description)
    parser.add_argument("--variant", action="append", default=[], metavar="NAME=FILE",
                        help="parameters to run with; NAME= for the defaults")
    arguments = parsed(parser)
    variants = variants_of(study, arguments)
    programs = programs_of(arguments)
    cases = list(all_cases(arguments))
    with ThreadPoolExecutor(arguments.jobs) as pool:
        measured = list(pool.map(
            lambda case: measure(case, variants, study, arguments, programs), cases))
    rows = [row for rows_of_case in measured for row in rows_of_case]
    if not rows:
        raise SystemExit("nothing was measured")
    write_csv(rows, study, arguments.out / f"{study.name}.csv")
    print_table(rows, variants, study)
    if any(len(rows_of_case) < len(variants) for rows_of_case in measured):
        raise SystemExit("not all runs were made")
