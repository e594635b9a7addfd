#!/usr/bin/env python3
"""Learns which cells beside a skeleton are the person's.

Reads what `dump_person_cells` wrote of simulated people and writes the trees of
src/posefusion/segmentation/person_trees.inc. Needs python3-numpy and python3-sklearn.

    simulate --preset fr3_xyz --humans 2 --seed 102 --seconds 14 --out D   # and others
    dump_person_cells D ... --out cells.bin
    train_person_trees.py cells.bin --out src/posefusion/segmentation/person_trees.inc
"""
import argparse

import numpy as np
from sklearn.ensemble import HistGradientBoostingClassifier

NUM_FEATURES = 19       # kNumCellFeatures
COLOUR_RATIO = 11       # kColourRatio
UNKNOWN_COLOURS = 0.15  # share of the cells for which nothing is known of colours, as at a start


def read(files, share, random):
    parts = []
    for name in files:
        rows = np.memmap(name, np.float32, 'r').reshape(-1, 1 + NUM_FEATURES)
        parts.append(np.array(rows[random.rand(len(rows)) < share]))
    return np.concatenate(parts)


def learn(rows, trees, random):
    rows[random.rand(len(rows)) < UNKNOWN_COLOURS, 1 + COLOUR_RATIO] = 0
    model = HistGradientBoostingClassifier(
        max_iter=trees, max_leaf_nodes=16, learning_rate=0.2, min_samples_leaf=200,
        l2_regularization=1, early_stopping=False, random_state=0)
    return model.fit(rows[:, 1:], rows[:, 0])


def report(model, rows):
    truth = rows[:, 0] > 0
    odds = model.decision_function(rows[:, 1:])
    for offset in (0, 1, 1.5, 2):
        person = odds > -offset
        hits = np.sum(truth & person)
        print('offset %.1f: recall %.4f precision %.4f'
              % (offset, hits / np.sum(truth), hits / np.sum(person)))


def literal(value):
    """A float of C++."""
    text = '%.6g' % value
    return text + ('F' if '.' in text or 'e' in text else '.0F')


def node_line(number, node):
    if node['is_leaf']:
        return '{-1, 0, 0, %s}' % literal(node['value'])
    return '{%d, %d, %d, %s}' % (node['feature_idx'], node['left'] - number,
                                 node['right'] - number, literal(node['num_threshold']))


def write(model, name):
    nodes, roots = [], []
    for (tree,) in model._predictors:
        roots.append(len(nodes))
        nodes += [node_line(i, node) for i, node in enumerate(tree.nodes)]
    with open(name, 'w') as out:
        out.write('// Written by scripts/train_person_trees.py.\n')
        out.write('std::vector<TreeNode> nodes = {\n')
        out.write(''.join('    %s,\n' % node for node in nodes))
        out.write('};\nstd::vector<int> roots = {%s};\n' % ', '.join(map(str, roots)))
        out.write('const float offset = %s;\n' % literal(model._baseline_prediction.item()))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
    parser.add_argument('cells', nargs='+', help='files of dump_person_cells')
    parser.add_argument('--out', required=True, help='person_trees.inc')
    parser.add_argument('--test', nargs='*', default=[], help='files to report figures of')
    parser.add_argument('--trees', type=int, default=60)
    parser.add_argument('--share', type=float, default=1.0, help='of the rows that are used')
    arguments = parser.parse_args()
    random = np.random.RandomState(0)
    model = learn(read(arguments.cells, arguments.share, random), arguments.trees, random)
    if arguments.test:
        report(model, read(arguments.test, 0.2, random))
    write(model, arguments.out)


if __name__ == '__main__':
    main()
