// The panel: plain inputs, built from what the program sends.

const PAUSE = 33 // milliseconds between two values of a slider that is dragged
const STEPS = 1000 // positions of a slider without a step

let built = '' // what the inputs were built from, without the values
let rows = []

const make = (tag, properties = {}, children = []) => {
  const element = Object.assign(document.createElement(tag), properties)
  element.append(...children)
  return element
}

export function showPanel (form, sections, change, done) {
  const shape = JSON.stringify(sections, (key, value) => key === 'value' ? undefined : value)
  if (shape !== built) {
    built = shape
    rows = sections.map((section, s) => section.controls.map((control, c) => makeRow(control, (value) => change([s, c], value))))
    form.replaceChildren(...sections.map((section, s) => make('details', { open: section.open }, [
      make('summary', { textContent: section.title }),
      ...rows[s].map((row) => row.element)
    ])))
  }
  sections.forEach((section, s) => section.controls.forEach((control, c) => {
    const row = rows[s][c]
    if (!row.element.contains(document.activeElement) || row.quiet()) row.show(control.value)
  }))
  done()
}

export function showProblem ([section, control], text) {
  const row = rows[section]?.[control]
  if (row === undefined) return
  row.problem.textContent = text
  row.element.classList.toggle('wrong', text !== '')
}

// ---- one row

let count = 0

function makeRow (control, change) {
  const id = `control-${count++}`
  const parts = (makers[control.kind] ?? makers.text)(control, slowed(change), id)
  const problem = make('p', { className: 'problem' })
  problem.setAttribute('role', 'alert')
  const label = control.kind === 'button' ? [] : [make('label', { htmlFor: id, textContent: control.name, title: control.help ?? '' })]
  const unit = control.unit ? [make('span', { className: 'unit', textContent: control.unit })] : []
  const element = make('div', { className: `row ${control.kind}` }, [...label, make('div', { className: 'inputs' }, [...parts.inputs, ...unit]), problem])
  for (const input of parts.inputs) {
    input.dataset.name = control.name
    input.setAttribute('aria-label', control.name)
  }
  return { element, problem, show: parts.show, quiet: parts.quiet ?? (() => true) }
}

// The first value goes out at once, the last one in any case, and between them one at a time.
function slowed (change) {
  let timer = null
  let waiting = null
  return (value) => {
    if (timer !== null) {
      waiting = [value]
      return
    }
    change(value)
    const next = () => {
      timer = null
      if (waiting !== null) {
        const [last] = waiting
        waiting = null
        change(last)
        timer = setTimeout(next, PAUSE)
      }
    }
    timer = setTimeout(next, PAUSE)
  }
}

const text = (value) => typeof value === 'number' ? String(Number(value.toPrecision(6))) : String(value ?? '')
const isRange = (control) => Number.isFinite(control.low) && Number.isFinite(control.high) && control.high > control.low

// What is being typed stays; a slider that is held stays.
const busy = (...inputs) => () => !inputs.some((input) => input === document.activeElement)

function makeNumber (control, change, id) {
  const field = make('input', { type: 'number', id, step: 'any' })
  if (Number.isFinite(control.low)) field.min = control.low
  if (Number.isFinite(control.high)) field.max = control.high
  if (control.kind === 'integer') field.step = 1
  else if (control.step) field.step = control.step
  field.step = control.kind === 'integer' ? 1 : 'any'
  if (!isRange(control)) {
    field.onchange = () => change(field.valueAsNumber)
    return { inputs: [field], show: (value) => { field.value = text(value) }, quiet: busy(field) }
  }
  const { low, high } = control
  const log = control.logarithmic && low > 0
  const toValue = (part) => {
    const value = log ? low * Math.pow(high / low, part) : low + part * (high - low)
    const step = control.kind === 'integer' ? 1 : control.step
    const kept = step && !log ? low + Math.round((value - low) / step) * step : value
    return Number(Math.min(Math.max(kept, low), high).toPrecision(6))
  }
  const toPart = (value) => log ? Math.log(Math.max(value, low) / low) / Math.log(high / low) : (value - low) / (high - low)
  const slider = make('input', { type: 'range', min: 0, max: STEPS, step: 1 })
  const fill = () => slider.style.setProperty('--part', `${slider.value / STEPS * 100}%`)
  slider.oninput = () => {
    const value = toValue(slider.value / STEPS)
    field.value = text(value)
    fill()
    change(value)
  }
  field.onchange = () => {
    slider.value = STEPS * toPart(field.valueAsNumber)
    fill()
    change(field.valueAsNumber)
  }
  const show = (value) => {
    field.value = text(value)
    if (Math.abs(toPart(value) - slider.value / STEPS) > 0.5 / STEPS) slider.value = STEPS * toPart(value)
    fill()
  }
  return { inputs: [slider, field], show, quiet: busy(slider, field) }
}

const toHex = (value) => typeof value === 'string' ? value : '#' + [0, 1, 2].map((i) => Math.round(255 * Math.min(Math.max(value[i], 0), 1)).toString(16).padStart(2, '0')).join('')

const makers = {
  number: makeNumber,
  integer: makeNumber,

  flag (control, change, id) {
    const input = make('input', { type: 'checkbox', id })
    input.onchange = () => change(input.checked)
    return { inputs: [input], show: (value) => { input.checked = value } }
  },

  choice (control, change, id) {
    const input = make('select', { id }, (control.choices ?? []).map((name) => make('option', { value: name, textContent: name })))
    input.onchange = () => change(input.value)
    return { inputs: [input], show: (value) => { input.value = value }, quiet: busy(input) }
  },

  color (control, change, id) {
    const input = make('input', { type: 'color', id })
    const field = make('input', { type: 'text', spellcheck: false })
    input.oninput = () => {
      field.value = input.value
      change(input.value)
    }
    field.onchange = () => change(field.value)
    const show = (value) => { input.value = field.value = toHex(value) }
    return { inputs: [input, field], show, quiet: busy(input, field) }
  },

  vector (control, change, id) {
    const inputs = []
    const show = (value) => {
      value.forEach((number, i) => { if (inputs[i]) inputs[i].value = text(number) })
    }
    for (let i = 0; i < (control.value?.length ?? 3); i++) {
      const input = make('input', { type: 'number', step: 'any' })
      if (i === 0) input.id = id
      input.onchange = () => change(inputs.map((one) => one.valueAsNumber))
      inputs.push(input)
    }
    return { inputs, show, quiet: busy(...inputs) }
  },

  text (control, change, id) {
    const input = make('input', { type: 'text', id, spellcheck: false })
    input.onchange = () => change(input.value)
    return { inputs: [input], show: (value) => { input.value = text(value) }, quiet: busy(input) }
  },

  button (control, change, id) {
    const input = make('button', { type: 'button', id, className: 'wide', textContent: control.name, title: control.help ?? '' })
    input.onclick = () => change(null)
    return { inputs: [input], show: () => {} }
  }
}
