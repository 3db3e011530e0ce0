"""The small library under every experiment: models, runs, stored results, tables."""
