"""The Jupyter kernel: cells are statements of qdot, answers are shown as `qdot.display` makes them.

``python3 -m qdot.kernel install`` tells Jupyter of it.
"""
