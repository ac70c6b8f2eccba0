# SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
# SPDX-License-Identifier: BSD-3-Clause
"""The tables of the benchmarks."""


def print_columns(columns, rows, names=2):
    """Rows are dicts by column; the first columns are names, the others numbers."""
    texts = [columns] + [[str(row[column]) for column in columns] for row in rows]
    widths = [max(len(text[k]) for text in texts) for k in range(len(columns))]
    for text in texts:
        words = [t.ljust(w) if k < names else t.rjust(w) for k, (t, w) in enumerate(zip(text, widths))]
        print("  ".join(words))
