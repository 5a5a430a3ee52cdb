'use strict';
const form = document.getElementById('filter');
const trials = [...document.querySelectorAll('details.trial')];
const shown = document.getElementById('shown');

function apply() {
  const words = form.words.value.toLowerCase().split(/\s+/).filter(Boolean);
  const fits = trial =>
    ['result', 'home', 'form', 'names'].every(key => !form[key].value || trial.dataset[key].split(' ').includes(form[key].value)) &&
    words.every(word => trial.querySelector('summary').textContent.toLowerCase().includes(word));
  let count = 0;
  for (const trial of trials) {
    trial.hidden = !fits(trial);
    count += trial.hidden ? 0 : 1;
  }
  shown.textContent = `${count} of ${trials.length} trials shown`;
}

form.addEventListener('input', apply);
form.addEventListener('submit', event => event.preventDefault());
apply();
